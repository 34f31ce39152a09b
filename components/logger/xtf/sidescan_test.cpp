#include "components/logger/xtf/sidescan.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>

#include "components/formats/xtf/writer.h"

using namespace ensonify;
using namespace ensonify::logger;

namespace {

constexpr double kSoundSpeed_mps = 1500.0;

/// Port counts 1, 2, 3, ..., starboard ten times that, with a gain of S log10(R) + O.
msg::Ping ping_of(std::size_t samples, double spreading_db, double offset_db) {
  msg::Ping ping;
  ping.sample_period_s = 2e-3;
  ping.first_sample_s = 0.0;
  ping.amplitude_upa = msg::Array<float>({2, samples});
  for (std::size_t i = 0; i < samples; ++i) {
    ping.amplitude_upa(0, i) = 1e6F * static_cast<float>(i + 1);
    ping.amplitude_upa(1, i) = 1e7F * static_cast<float>(i + 1);
  }
  ping.applied.frequency_hz = 455e3;
  ping.applied.pulse_length_s = 50e-6;
  ping.applied.source_level_db = 210.0;
  ping.applied.range_m = 100.0;
  ping.applied.transmit_beamwidth_rad = 0.01;
  ping.applied.sound_speed_mps = kSoundSpeed_mps;
  ping.applied.gain_spreading_db = spreading_db;
  ping.applied.gain_offset_db = offset_db;
  return ping;
}

template <class Number>
std::vector<double> numbers(const formats::xtf::Channel& channel) {
  std::vector<double> found;
  for (std::size_t at = 0; at + sizeof(Number) <= channel.samples.size(); at += sizeof(Number)) {
    Number number;
    std::memcpy(&number, channel.samples.data() + at, sizeof number);
    found.push_back(static_cast<double>(number));
  }
  return found;
}

}  // namespace

TEST_CASE("port runs from far to near, starboard from near to far, over the whole slant range") {
  const auto channels = xtf_channels(ping_of(10, 0.0, 0.0), 2, XtfSamples::kFloat);
  REQUIRE(channels.size() == 2);
  const auto port = numbers<float>(channels[0]), starboard = numbers<float>(channels[1]);
  REQUIRE(port.size() == 10);
  for (std::size_t i = 0; i < 10; ++i) {
    CHECK(port[i] == Approx(1e6 * static_cast<double>(10 - i)));
    CHECK(starboard[i] == Approx(1e7 * static_cast<double>(i + 1)));
  }
  CHECK(channels[0].number == 2);
  CHECK(channels[1].number == 3);
  CHECK(channels[0].slant_range_m == Approx(0.5 * kSoundSpeed_mps * 10 * 2e-3));
  CHECK(channels[0].frequency_khz == 455);
}

TEST_CASE("samples have the operator's gain in them, at their range") {
  const auto without = numbers<float>(xtf_channels(ping_of(50, 0.0, 0.0), 0, XtfSamples::kFloat)[1]);
  const auto with = numbers<float>(xtf_channels(ping_of(50, 40.0, 6.0), 0, XtfSamples::kFloat)[1]);
  for (const std::size_t i : {10U, 30U, 49U}) {
    const double range_m = 0.5 * kSoundSpeed_mps * static_cast<double>(i) * 2e-3;
    CHECK(20.0 * std::log10(with[i] / without[i]) == Approx(40.0 * std::log10(range_m) + 6.0).margin(1e-3));
  }
}

TEST_CASE("integers are amplitudes over a full scale by the settings alone") {
  const msg::Ping ping = ping_of(50, 30.0, 0.0);
  // 210 dB, a cell of 0.0375 m times 0.01 rad, 10 dB above.
  CHECK(20.0 * std::log10(full_scale_upa(ping.applied)) == Approx(220.0 + 10.0 * std::log10(0.0375 * 0.01)));
  const auto exact = numbers<float>(xtf_channels(ping, 0, XtfSamples::kFloat)[1]);
  const auto sixteen = numbers<std::uint16_t>(xtf_channels(ping, 0, XtfSamples::k16Bit)[1]);
  const auto eight = numbers<std::uint8_t>(xtf_channels(ping, 0, XtfSamples::k8Bit)[1]);
  for (const std::size_t i : {0U, 5U, 49U}) {
    const double share = exact[i] / full_scale_upa(ping.applied);
    CHECK(sixteen[i] == Approx(std::min(65535.0, 65535.0 * share)).margin(0.51));
    CHECK(eight[i] == Approx(std::min(255.0, 255.0 * share)).margin(0.51));
  }
}

TEST_CASE("counts of a converter are written as they are") {
  msg::Ping ping = ping_of(3, 30.0, 0.0);
  ping.amplitude_upa = {};
  ping.amplitude_count = msg::Array<std::uint16_t>({2, 3});
  for (std::size_t i = 0; i < 3; ++i) ping.amplitude_count(1, i) = static_cast<std::uint16_t>(7 * i);
  CHECK(numbers<std::uint16_t>(xtf_channels(ping, 0, XtfSamples::k16Bit)[1]) == std::vector<double>{0, 7, 14});
}

TEST_CASE("more samples than readers bear are joined by their mean square") {
  const auto channels = xtf_channels(ping_of(20'000, 0.0, 0.0), 0, XtfSamples::k16Bit);
  const auto most = formats::xtf::kMostSampleBytes;
  CHECK(channels[1].samples.size() <= most);
  CHECK(channels[1].sample_count == 6'667);
  const auto exact = numbers<float>(xtf_channels(ping_of(20'000, 0.0, 0.0), 0, XtfSamples::kFloat)[1]);
  CHECK(exact.size() == 4'000);  // five each
  CHECK(exact[0] == Approx(1e7 * std::sqrt((1.0 + 4.0 + 9.0 + 16.0 + 25.0) / 5.0)));
  CHECK(channels[1].slant_range_m == Approx(0.5 * kSoundSpeed_mps * 20'000 * 2e-3));
}

TEST_CASE("a ping that is not of two sides has no channels") {
  msg::Ping ping;
  CHECK(xtf_channels(ping, 0, XtfSamples::k16Bit).empty());
  ping.amplitude_upa = msg::Array<float>({3, 5});
  CHECK(xtf_channels(ping, 0, XtfSamples::k16Bit).empty());
}
