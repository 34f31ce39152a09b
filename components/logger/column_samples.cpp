#include "components/logger/column_samples.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "components/logger/beam_fields.h"

namespace ensonify::logger {

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
// Noise of the water and the strongest seabed both are within what is written.
constexpr double kOffset_db = 40.0;
constexpr std::size_t kMostSamples = 65'000;

double level_db(double amplitude_upa) { return 20.0 * std::log10(amplitude_upa); }

/// What is added to a level at each sample: the gain at its range, by the head's sound speed, and the offset.
std::vector<float> gains_db(const msg::Ping& column, std::size_t samples, double log_factor) {
  std::vector<float> gains(samples);
  for (std::size_t k = 0; k < samples; ++k) {
    const double time_s = column.first_sample_s + static_cast<double>(k) * column.sample_period_s;
    const double range_m = std::max(0.5 * time_s * column.applied.sound_speed_mps, 1.0);
    gains[k] = static_cast<float>(log_factor * std::log10(range_m) +
                                  2.0 * column.applied.gain_absorption_dbpm * range_m + kOffset_db);
  }
  return gains;
}

/// Levels of one beam, re 1 uPa; counts of a converter have the head's gain in them, which is taken out.
std::vector<float> levels_db(const msg::Ping& column, std::size_t beam, std::span<const float> gains,
                             std::size_t samples) {
  constexpr float kDecibels = 8.685889638F;  // of a factor of e
  std::vector<float> levels(samples);
  if (column.amplitude_count.empty()) {
    for (std::size_t k = 0; k < samples; ++k)
      levels[k] = kDecibels * std::log(std::max(column.amplitude_upa(beam, k), 1e-6F));
    return levels;
  }
  const auto count_db = static_cast<float>(level_db(column.count_upa) - column.applied.gain_offset_db + kOffset_db);
  for (std::size_t k = 0; k < samples; ++k) {
    const auto counts = static_cast<float>(column.amplitude_count(beam, k));
    levels[k] = kDecibels * std::log(std::max(counts, 1e-6F)) + count_db - gains[k];
  }
  return levels;
}

std::int8_t half_decibels(float value_db) {
  return static_cast<std::int8_t>(std::lround(std::clamp(2.0F * value_db, -128.0F, 127.0F)));
}

/// The first detection of each beam, in samples; 0: none.
std::vector<double> detected_samples(const msg::Soundings& soundings, std::size_t beams, double period_s) {
  std::vector<double> detected(beams, 0.0);
  for (std::size_t i = 0; i < soundings.beam_angle_rad.size(); ++i) {
    const std::size_t beam = i < soundings.beam.size() ? soundings.beam[i] : i;
    if (beam >= beams || detected[beam] > 0.0 || !is_valid(soundings, i)) continue;
    detected[beam] = static_cast<double>(soundings.travel_time_s[i]) / period_s;
  }
  return detected;
}

}  // namespace

ColumnSamples column_samples(const LoggedSoundings& ping, const PingPlace& place) {
  const msg::Ping& column = *ping.water_column;
  const auto& shape = column.amplitude_count.empty() ? column.amplitude_upa.shape() : column.amplitude_count.shape();
  ColumnSamples written;
  if (shape.size() != 2) return written;
  const std::size_t samples = std::min(shape[1], kMostSamples) / 2 * 2;  // an even number, as .all has it
  written.first_sample = count_of(column.first_sample_s / column.sample_period_s);
  written.log_factor = static_cast<std::uint8_t>(std::clamp(std::round(column.applied.gain_spreading_db), 0.0, 255.0));
  written.offset_db = static_cast<std::int8_t>(kOffset_db);
  const auto gains = gains_db(column, samples, written.log_factor);
  const auto detected = detected_samples(ping.soundings, shape[0], column.sample_period_s);
  const auto sectors = sectors_of(column.applied);
  for (std::size_t i = 0; i < shape[0]; ++i) {
    ColumnSamples::Beam& beam = written.beams.emplace_back();
    const double angle_rad = at_or_nan(column.beam_angle_rad, i);
    const frames::Vec3 axis = place.level_from_head * frames::Vec3(0.0, std::sin(angle_rad), std::cos(angle_rad));
    beam.angle_deg = std::atan2(-axis.y(), axis.z()) / kDegree;
    beam.sector = i < column.beam_sector.size() ? column.beam_sector[i] : 0;
    beam.detected_sample = detected[i];
    const auto source_db =
        static_cast<float>(sectors[std::min<std::size_t>(beam.sector, sectors.size() - 1)].source_level_db);
    const auto levels = levels_db(column, i, gains, samples);
    beam.half_db.resize(samples);
    for (std::size_t k = 0; k < samples; ++k) beam.half_db[k] = half_decibels(levels[k] - source_db + gains[k]);
  }
  return written;
}

}  // namespace ensonify::logger
