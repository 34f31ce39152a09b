#include "components/logger/xtf/sidescan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <span>

#include "components/formats/xtf/writer.h"
#include "kernels/acoustics/echo/gain.h"

namespace ensonify::logger {

using namespace formats::xtf;

namespace {

constexpr std::uint16_t kRootMeanSquare = 4;  // of the format's ways to take fewer samples
constexpr std::size_t kSides = 2;

double greatest(XtfSamples samples) { return samples == XtfSamples::k8Bit ? 255.0 : 65535.0; }

/// A side's amplitudes with the gain in them, in the units that are written.
std::vector<float> side_of(const msg::Ping& ping, std::size_t side, std::span<const float> gain_db,
                           XtfSamples samples) {
  const bool counts = !ping.amplitude_count.empty();
  const std::size_t count = (counts ? ping.amplitude_count.shape() : ping.amplitude_upa.shape())[1];
  std::vector<float> values(count);
  if (counts) {
    const auto upa = static_cast<float>(samples == XtfSamples::kFloat ? ping.count_upa : 1.0);
    for (std::size_t i = 0; i < count; ++i) values[i] = upa * static_cast<float>(ping.amplitude_count(side, i));
    return values;
  }
  for (std::size_t i = 0; i < count; ++i) values[i] = ping.amplitude_upa(side, i);
  echo::apply_gain(gain_db, values);
  if (samples != XtfSamples::kFloat) {
    const auto scale = static_cast<float>(greatest(samples) / full_scale_upa(ping.applied));
    for (float& value : values) value *= scale;
  }
  return values;
}

std::vector<float> joined(std::span<const float> values, std::size_t each) {
  std::vector<float> fewer;
  for (std::size_t i = 0; i < values.size(); i += each) {
    const auto part = values.subspan(i, std::min(each, values.size() - i));
    double power = 0.0;
    for (const float value : part) power += double{value} * double{value};
    fewer.push_back(static_cast<float>(std::sqrt(power / static_cast<double>(part.size()))));
  }
  return fewer;
}

template <class Number>
void append(formats::Bytes& bytes, Number number) {
  std::array<std::byte, sizeof number> raw;
  std::memcpy(raw.data(), &number, sizeof number);
  bytes.insert(bytes.end(), raw.begin(), raw.end());
}

formats::Bytes bytes_of(std::span<const float> values, XtfSamples samples) {
  formats::Bytes bytes;
  const auto whole = [&](float value) { return std::lround(std::clamp(double{value}, 0.0, greatest(samples))); };
  for (const float value : values) {
    if (samples == XtfSamples::kFloat) append(bytes, value);
    else if (samples == XtfSamples::k16Bit) append(bytes, static_cast<std::uint16_t>(whole(value)));
    else append(bytes, static_cast<std::uint8_t>(whole(value)));
  }
  return bytes;
}

}  // namespace

std::uint16_t bytes_of(XtfSamples samples) {
  return samples == XtfSamples::kFloat ? 4 : samples == XtfSamples::k16Bit ? 2 : 1;
}

std::uint8_t format_of(XtfSamples samples) {
  return samples == XtfSamples::kFloat ? 5 : samples == XtfSamples::k16Bit ? 3 : 8;
}

std::size_t joined_samples(std::size_t count, XtfSamples samples) {
  const std::size_t most = kMostSampleBytes / bytes_of(samples);
  return std::max<std::size_t>((count + most - 1) / most, 1);
}

double full_scale_upa(const msg::AppliedSettings& settings) {
  constexpr double kAbove_db = 10.0;
  const double length_m = 0.5 * settings.sound_speed_mps *
                          (settings.bandwidth_hz > 0.0 ? 1.0 / settings.bandwidth_hz : settings.pulse_length_s);
  const double spreading_db =
      std::max(0.0, (settings.gain_spreading_db - 30.0) * std::log10(std::max(settings.range_m, 1.0)));
  const double level_db = settings.source_level_db + 10.0 * std::log10(length_m * settings.transmit_beamwidth_rad) +
                          spreading_db + settings.gain_offset_db + kAbove_db;
  return std::pow(10.0, level_db / 20.0);
}

std::vector<Channel> xtf_channels(const msg::Ping& ping, std::uint16_t first, XtfSamples samples) {
  const auto& shape = ping.amplitude_count.empty() ? ping.amplitude_upa.shape() : ping.amplitude_count.shape();
  if (shape.size() != 2 || shape[0] != kSides || shape[1] == 0) return {};
  std::vector<float> gain_db;
  echo::tvg_db({.spreading_db = ping.applied.gain_spreading_db,
                .absorption_dbpm = ping.applied.gain_absorption_dbpm,
                .offset_db = ping.applied.gain_offset_db,
                .sound_speed_mps = ping.applied.sound_speed_mps},
               {ping.first_sample_s, ping.sample_period_s, static_cast<int>(shape[1])}, gain_db);
  const std::size_t each = joined_samples(shape[1], samples);
  std::vector<Channel> channels;
  for (std::size_t side = 0; side < kSides; ++side) {
    std::vector<float> values = side_of(ping, side, gain_db, samples);
    if (each > 1) values = joined(values, each);
    if (side == 0) std::reverse(values.begin(), values.end());
    const double duration_s = static_cast<double>(shape[1]) * ping.sample_period_s;
    Channel channel{.number = static_cast<std::uint16_t>(first + side)};
    channel.downsample_method = each > 1 ? kRootMeanSquare : 0;
    channel.slant_range_m = static_cast<float>(0.5 * ping.applied.sound_speed_mps * (ping.first_sample_s + duration_s));
    channel.delay_s = static_cast<float>(ping.first_sample_s);
    channel.duration_s = static_cast<float>(duration_s);
    channel.seconds_per_ping =
        static_cast<float>(ping.applied.ping_rate_hz > 0.0 ? 1.0 / ping.applied.ping_rate_hz : duration_s);
    channel.frequency_khz = static_cast<std::uint16_t>(std::lround(1e-3 * ping.applied.frequency_hz));
    channel.bandwidth_khz = static_cast<std::uint16_t>(std::lround(1e-3 * ping.applied.bandwidth_hz));
    channel.sample_count = static_cast<std::uint32_t>(values.size());
    channel.millivolt_scale = 5000;
    channel.bytes_per_sample = bytes_of(samples);
    channel.samples = bytes_of(values, samples);
    channels.push_back(std::move(channel));
  }
  return channels;
}

}  // namespace ensonify::logger
