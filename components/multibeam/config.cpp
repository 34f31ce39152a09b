#include "components/multibeam/config.h"

#include <algorithm>
#include <cmath>

#include "components/config/config_reader.h"
#include "components/sonar/environment.h"
#include "components/sonar/line_shading.h"
#include "components/sonar/tone_shape.h"

namespace ensonify {
namespace {

constexpr double kFastest_hz = 100.0;
constexpr double kMostSamples = 20000;  // per beam: 20 MB of ping with 256 beams
constexpr double kLongestPulse_s = 10e-3;
constexpr double kLeastSweep = 4.0;  // bandwidth times length of a chirp
constexpr double kChirpTail = 2.0;   // inverse bandwidths after a point's echo in which it is still received
constexpr double kNarrowestSwath_rad = 1.0 * MultibeamConfig::kDegree;
constexpr double kWidestSwath_rad = 170.0 * MultibeamConfig::kDegree;
constexpr int kMostSoundings = 2048;

using Spacing = MultibeamConfig::Spacing;

void read_array(ConfigReader& from, MultibeamConfig& c) {
  from.optional("frequency_hz", c.frequency_hz, 50e3, 1e6);
  from.optional("beams", c.beams, 2, 1024);
  from.optional("swath_deg", c.swath_rad, 1, 170, kDegrees);
  from.optional_choice("spacing", c.spacing,
                       {{"equiangle", Spacing::kEquiangle},
                        {"equidistant", Spacing::kEquidistant},
                        {"high_density", Spacing::kHighDensity}});
  from.optional("soundings", c.soundings, 0, kMostSoundings);
  from.optional("detections_per_beam", c.detections_per_beam, 1, 8);
  from.optional("transmit_beamwidth_deg", c.transmit_beamwidth_rad, 0.1, 20, kDegrees);
  from.optional("receive_beamwidth_deg", c.receive_beamwidth_rad, 0.1, 20, kDegrees);
  read_shading(from, "transmit_shading", c.transmit_shading);
  read_shading(from, "receive_shading", c.receive_shading);
  from.optional("back_loss_db", c.back_loss_db, 0, 100);
  from.optional("electronic_noise_db", c.electronic_noise_db, -200, 150);
}

void read_sectors(ConfigReader& from, MultibeamConfig& c) {
  for (ConfigReader& section : from.list("sectors")) {
    MultibeamConfig::Sector sector{.frequency_hz = c.frequency_hz};
    section.optional("share", sector.share, 0.01, 100);
    section.optional("frequency_hz", sector.frequency_hz, 50e3, 1e6);
    section.optional("tilt_deg", sector.tilt_rad, -20, 20, kDegrees);
    section.optional("delay_s", sector.delay_s, 0, 0.1);
    c.sectors.push_back(sector);
  }
  from.optional("sector_rejection_db", c.sector_rejection_db, 0, 200);
  if (c.sectors.size() > 16) from.problem("sectors", "are " + std::to_string(c.sectors.size()) + "; at most 16");
}

void read_ping(ConfigReader& from, MultibeamConfig& c) {
  from.optional_choice("pulse", c.chirp, {{"tone", false}, {"chirp", true}});
  from.optional("pulse_length_s", c.pulse_length_s, 5e-6, kLongestPulse_s);
  read_taper(from, c.chirp, c.tapered_fraction);
  from.optional("bandwidth_hz", c.bandwidth_hz, 0, 500e3);
  read_window(from, c.window);
  from.optional("source_level_db", c.source_level_db, -300, 250);
  from.optional("roll_stabilised", c.roll_stabilised);
  from.optional("pitch_stabilised", c.pitch_stabilised);
  from.optional("yaw_stabilised", c.yaw_stabilised);
  from.optional("heading_mean_s", c.heading_mean_s, 0.1, 1000);
  from.optional("attitude_latency_s", c.attitude_latency_s, 0, 1);
  from.optional("auto_range", c.auto_range);
  from.optional("range_m", c.range_m, 1, 2000);
  from.optional("sample_rate_hz", c.sample_rate_hz, 1e3, 1e6);
}

void read_receiver(ConfigReader& from, MultibeamConfig& c) {
  from.optional("detection_threshold_db", c.detection_threshold_db, 0, 60);
  from.optional("least_range_m", c.least_range_m, 0, 2000);
  from.optional("refuse_second_echo", c.refuse_second_echo);
  from.optional_choice("mode", c.mode, {{"bathymetry", "bathymetry"}, {"water_column", "water_column"}});
  from.optional("amplitude_every", c.amplitude_every, 1, 1'000'000);
  from.optional("phase_every", c.phase_every, 0, 1'000'000);
  from.optional("snippets", c.snippets);
  if (auto image = from.optional_section("seabed_image")) {
    image->optional("published", c.image.published);
    image->optional("normal_strength_db", c.image.normal_strength_db, -80, 20);
    image->optional("oblique_strength_db", c.image.oblique_strength_db, -80, 20);
    image->optional("crossover_deg", c.image.crossover_rad, 1, 60, kDegrees);
  }
}

void read_uncertainty(ConfigReader& from, MultibeamConfig::Uncertainty& u) {
  auto section = from.optional_section("uncertainty");
  if (!section) return;
  section->optional("position_m", u.position_m, 0, 1000);
  section->optional("height_m", u.height_m, 0, 1000);
  section->optional("level_deg", u.level_rad, 0, 10, kDegrees);
  section->optional("heading_deg", u.heading_rad, 0, 10, kDegrees);
  uncertainty::Sources& s = u.sources;
  section->optional("heave_m", s.heave_m, 0, 10);
  section->optional("draught_m", s.draught_m, 0, 10);
  section->optional("squat_m", s.squat_m, 0, 10);
  section->optional("tide_m", s.tide_m, 0, 10);
  section->optional("cast_mps", s.cast_mps, 0, 100);
  section->optional("face_mps", s.face_mps, 0, 100);
  section->optional("lever_arm_m", s.lever_arm_m, 0, 10);
  section->optional("roll_deg", s.roll_rad, 0, 10, kDegrees);
  section->optional("pitch_deg", s.pitch_rad, 0, 10, kDegrees);
  section->optional("yaw_deg", s.yaw_rad, 0, 10, kDegrees);
  section->optional("position_latency_s", s.position_latency_s, 0, 10);
  section->optional("attitude_latency_s", s.attitude_latency_s, 0, 10);
  section->optional("along_deg", s.along_rad, 0, 10, kDegrees);
}

void check_pulse(ConfigReader& from, const MultibeamConfig& c) {
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

void check(ConfigReader& from, const MultibeamConfig& c) {
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
  read_array(from, c);
  read_sectors(from, c);
  read_ping(from, c);
  read_receiver(from, c);
  read_uncertainty(from, c.uncertainty);

  read_head(from, world, process, kFastest_hz, c);
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
  limits.auto_range = true;
  // A tone has two samples or more; a chirp's length changes neither resolution nor samples.
  limits.pulse_length_s = {chirp ? kLeastSweep / bandwidth_hz : 2.0 / sample_rate_hz, kLongestPulse_s};
  limits.gain_spreading_db = {0.0, 80.0};
  limits.gain_absorption_dbpm = {0.0, 2.0};
  limits.swath_rad = {kNarrowestSwath_rad, kWidestSwath_rad};
  limits.modes = {"bathymetry", "water_column"};
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
