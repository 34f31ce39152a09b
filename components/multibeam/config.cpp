#include "components/multibeam/config.h"

#include <algorithm>
#include <cmath>

#include "components/runtime/config/config_reader.h"
#include "components/runtime/head/effects.h"
#include "components/runtime/head/environment.h"
#include "components/runtime/head/head_motion.h"

namespace ensonify {
namespace {

constexpr FileUnit kDecibelsPerKilometre{1e-3};
constexpr double kMostSamples = 20000;  // per beam: 20 MB of ping with 256 beams
constexpr double kLongestPulse_s = 10e-3;
constexpr double kWeakest_db = 40.0;  // below the highest source level, that can be set
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
  from.optional("pulse_length_s", c.pulse_length_s, 5e-6, kLongestPulse_s);
  from.optional("source_level_db", c.source_level_db, -300, 250);
  from.optional("roll_stabilised", c.roll_stabilised);
  from.optional("pitch_stabilised", c.pitch_stabilised);
  from.optional("yaw_stabilised", c.yaw_stabilised);
  from.optional("heading_mean_s", c.heading_mean_s, 0.1, 1000);
  from.optional("attitude_latency_s", c.attitude_latency_s, 0, 1);
  from.optional("auto_range", c.auto_range);
  from.optional("range_m", c.range_m, 1, 2000);
  from.optional("ping_rate_hz", c.ping_rate_hz, 0.01, 100);
  from.optional("dead_time_s", c.dead_time_s, 0, 1);
  from.optional("processing_latency_s", c.processing_latency_s, 0, 10);
  from.optional("sample_rate_hz", c.sample_rate_hz, 1e3, 1e6);
}

void read_receiver(ConfigReader& from, MultibeamConfig& c) {
  from.optional("gain_spreading_db", c.gain_spreading_db, 0, 80);
  from.optional("gain_absorption_db_per_km", c.gain_absorption_dbpm, 0, 2000, kDecibelsPerKilometre);
  from.optional("gain_offset_db", c.gain_offset_db, -200, 200);
  read_converter(from, c.converter);
  read_quality(from, c.quality);
  from.optional("detection_threshold_db", c.detection_threshold_db, 0, 60);
  from.optional("least_range_m", c.least_range_m, 0, 2000);
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
  read_trigger(from, c.trigger);
  read_effects(from, c.effects);
}

void check(ConfigReader& from, const MultibeamConfig& c) {
  // The narrowest envelope that a pulse leaves is as long as the pulse: two samples of it, or echoes fall between.
  if (c.sample_rate_hz * c.pulse_length_s < 1.999) {
    from.problem("sample_rate_hz", std::to_string(c.sample_rate_hz) + " is below two samples per pulse, " +
                                       std::to_string(2.0 / c.pulse_length_s) + " Hz");
  }
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

MultibeamConfig MultibeamConfig::read(ConfigReader& from, const Scenario& scenario, const std::string& process) {
  MultibeamConfig c;
  read_array(from, c);
  read_sectors(from, c);
  read_ping(from, c);
  read_receiver(from, c);

  c.interference = read_interference(from, scenario, process, c.processing_latency_s);
  c.world = scenario;
  c.process = process;
  c.mounting = read_mounting(from, scenario, process);
  c.sound_speed_mps = applied_profile(scenario).speed_mps(scenario.mission.depth_m);
  check(from, c);
  return c;
}

HeadSettings MultibeamConfig::start() const {
  HeadSettings start;
  start.auto_range = auto_range;
  start.range_m = range_m;
  start.source_level_db = source_level_db;
  start.pulse_length_s = pulse_length_s;
  start.gain_spreading_db = gain_spreading_db;
  start.gain_absorption_dbpm = gain_absorption_dbpm;
  start.gain_offset_db = gain_offset_db;
  start.swath_rad = swath_rad;
  start.ping_rate_hz = ping_rate_hz;
  start.mode = mode;
  return start;
}

SettingLimits MultibeamConfig::limits() const {
  SettingLimits limits;
  limits.auto_range = true;
  limits.range_m = {1.0, range_m};
  limits.source_level_db = {source_level_db - kWeakest_db, source_level_db};
  limits.pulse_length_s = {2.0 / sample_rate_hz, kLongestPulse_s};
  limits.gain_spreading_db = {0.0, 80.0};
  limits.gain_absorption_dbpm = {0.0, 2.0};
  limits.gain_offset_db = {-200.0, 200.0};
  limits.swath_rad = {kNarrowestSwath_rad, kWidestSwath_rad};
  limits.ping_rate_hz = {0.01, ping_rate_hz};
  limits.modes = {"bathymetry", "water_column"};
  return limits;
}

std::vector<MultibeamConfig::Sector> MultibeamConfig::all_sectors() const {
  return sectors.empty() ? std::vector{Sector{.frequency_hz = frequency_hz}} : sectors;
}

double MultibeamConfig::listening_s(double of_range_m, double of_pulse_length_s) const {
  double delay_s = 0.0;
  for (const Sector& sector : sectors) delay_s = std::max(delay_s, sector.delay_s);
  return delay_s + 2.0 * of_range_m / sound_speed_mps + of_pulse_length_s;
}

int MultibeamConfig::samples(double of_range_m, double of_pulse_length_s) const {
  return static_cast<int>(std::ceil(listening_s(of_range_m, of_pulse_length_s) * sample_rate_hz));
}

double MultibeamConfig::longest_listening_s() const {
  return listening_s(range_m, std::max(pulse_length_s, kLongestPulse_s));
}

int MultibeamConfig::most_samples() const { return samples(range_m, std::max(pulse_length_s, kLongestPulse_s)); }

}  // namespace ensonify
