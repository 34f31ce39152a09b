#include "components/multibeam/config.h"

#include <algorithm>
#include <cmath>

#include "components/config/read_parameters.h"
#include "components/sonar/environment.h"
#include "components/sonar/ranged_pulse.h"

namespace ensonify {
namespace {

constexpr double kMostSamples = 20000;  // per beam: 20 MB of ping with 256 beams
constexpr double kLeastSweep = 4.0;     // bandwidth times length of a chirp
constexpr double kChirpTail = 2.0;      // inverse bandwidths after a point's echo in which it is still received
constexpr double kNarrowestSwath_rad = 1.0 * MultibeamConfig::kDegree;
constexpr double kWidestSwath_rad = 170.0 * MultibeamConfig::kDegree;
using Spacing = MultibeamConfig::Spacing;

void check_pulse(const ConfigReader& from, const MultibeamConfig& c) {
  check_taper(from, c.chirp, c.tapered_fraction);
  if (!c.chirp && c.bandwidth_hz != 0.0) from.problem("bandwidth_hz", "only a chirp sweeps; set pulse: chirp");
  if (c.chirp && c.bandwidth_hz * c.pulse_length_s < kLeastSweep) {
    from.problem("bandwidth_hz", "times pulse_length_s is " + std::to_string(c.bandwidth_hz * c.pulse_length_s) +
                                     ": a chirp needs at least 4");
    return;
  }
  // The narrowest envelope that a tone leaves is as long as the tone: two samples of it, or echoes fall between.
  const double least_hz = 2.0 / c.resolved_s(c.pulse_length_s);
  if (c.sample_rate_hz < 0.9995 * least_hz) {
    from.problem("sample_rate_hz", std::to_string(c.sample_rate_hz) + " is below two samples per " +
                                       (c.chirp ? "1 / bandwidth, " : "pulse, ") + std::to_string(least_hz) + " Hz");
  }
}

void check(const ConfigReader& from, const MultibeamConfig& c) {
  if (c.sectors.size() > 16) from.problem("sectors", "are " + std::to_string(c.sectors.size()) + "; at most 16");
  check_pulse(from, c);
  if (c.samples(c.range_m, c.pulse_length_s) > kMostSamples) {
    from.problem("range_m", "makes " + std::to_string(c.samples(c.range_m, c.pulse_length_s)) +
                                " samples per beam; at most " + std::to_string(static_cast<int>(kMostSamples)) +
                                " are allowed: shorten it or lower sample_rate_hz");
  }
  if (c.spacing == Spacing::kHighDensity && c.soundings != 0 && c.soundings < c.beams) {
    from.problem("soundings", std::to_string(c.soundings) + " are fewer than the beams");
  }
}

}  // namespace

MultibeamConfig MultibeamConfig::read(ConfigReader& from, const World& world, const std::string& process) {
  MultibeamConfig c;
  read_parameters(from, c);
  for (Sector& sector : c.sectors) {
    if (sector.frequency_hz == 0.0) sector.frequency_hz = c.frequency_hz;
  }
  place_head(from, world, process, c);
  c.sound_speed_mps = applied_profile(world).speed_mps(world.mission.depth_m);
  check(from, c);
  return c;
}

uncertainty::Navigation MultibeamParameters::Uncertainty::unstated() const {
  uncertainty::Navigation navigation;
  navigation.position_enu_m2.diagonal() << position_m * position_m, position_m * position_m, height_m * height_m;
  navigation.rotation_enu_rad2.diagonal() << level_rad * level_rad, level_rad * level_rad, heading_rad * heading_rad;
  return navigation;
}

/// The gain's settings stand whether it is applied or not: soundings use the absorption.
HeadSettings MultibeamConfig::start() const {
  HeadSettings start = start_at(range_m, source_level_db);
  start.auto_range = auto_range;
  start.pulse_length_s = pulse_length_s;
  start.gain_spreading_db = gain_spreading_db;
  start.gain_absorption_dbpm = gain_absorption_dbpm;
  start.swath_rad = swath_rad;
  start.mode = mode;
  return start;
}

SettingLimits MultibeamConfig::limits() const {
  SettingLimits limits = limits_up_to(1.0, range_m, source_level_db);
  limits["range_m"].chosen = true;
  // A tone has two samples or more; a chirp's length changes neither resolution nor samples.
  limits["pulse_length_s"] = {{chirp ? kLeastSweep / bandwidth_hz : 2.0 / sample_rate_hz, kLongestPulse_s}};
  limits["gain_spreading_db"] = {kSpreading_db};
  limits["gain_absorption_dbpm"] = {kAbsorption_dbpm};
  limits["swath_rad"] = {{kNarrowestSwath_rad, kWidestSwath_rad}};
  limits["mode"].words = {"bathymetry", "water_column"};
  return limits;
}

std::vector<MultibeamConfig::Sector> MultibeamConfig::all_sectors() const {
  return sectors.empty() ? std::vector{Sector{.frequency_hz = frequency_hz}} : sectors;
}

echo::Pulse MultibeamConfig::pulse(double of_length_s) const {
  if (chirp) return echo::compressed_chirp(of_length_s, bandwidth_hz, window);
  return echo::tapered_pulse(of_length_s, tapered_fraction);
}

double MultibeamConfig::last_start_s(double of_range_m) const {
  double delay_s = 0.0;
  for (const Sector& sector : sectors) delay_s = std::max(delay_s, sector.delay_s);
  return delay_s + 2.0 * of_range_m / sound_speed_mps;
}

double MultibeamConfig::reception_s(double of_range_m, double of_pulse_length_s) const {
  return last_start_s(of_range_m) + of_pulse_length_s;
}

int MultibeamConfig::samples(double of_range_m, double of_pulse_length_s) const {
  const double tail_s = (chirp ? kChirpTail : 1.0) * resolved_s(of_pulse_length_s);
  return static_cast<int>(std::ceil((last_start_s(of_range_m) + tail_s) * sample_rate_hz));
}

double MultibeamConfig::longest_reception_s() const {
  return reception_s(range_m, std::max(pulse_length_s, kLongestPulse_s));
}

int MultibeamConfig::most_samples() const { return samples(range_m, std::max(pulse_length_s, kLongestPulse_s)); }

}  // namespace ensonify
