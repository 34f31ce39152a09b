#include "components/scanning/config.h"

#include "components/runtime/config/config_reader.h"
#include "components/runtime/head/head_motion.h"

namespace ensonify {
namespace {

constexpr FileUnit kDecibelsPerKilometre{1e-3};
constexpr double kWeakest_db = 40.0;  // below the highest source level, that can be set

void read_scan(ConfigReader& from, Scan& scan) {
  from.optional("sector_centre_deg", scan.centre_rad, -180, 180, kDegrees);
  from.optional("sector_width_deg", scan.width_rad, 0.1, 360, kDegrees);
  from.optional("step_deg", scan.step_rad, 0.05, 30, kDegrees);
  from.optional("steps_per_ping", scan.steps_per_ping, 1, 100);
  from.optional_choice("turning", scan.reversing, {{"continuous", false}, {"reversing", true}});
  if (scan.step_rad * scan.steps_per_ping > scan.width_rad) {
    from.problem("sector_width_deg", "is less than what the head turns between two pings");
  }
}

}  // namespace

ScanningConfig ScanningConfig::read(ConfigReader& from, const Scenario& scenario, const std::string& process) {
  ScanningConfig c;
  from.optional("frequency_hz", c.frequency_hz, 50e3, 3e6);
  from.optional("horizontal_beamwidth_deg", c.horizontal_beamwidth_rad, 0.2, 20, kDegrees);
  from.optional("vertical_beamwidth_deg", c.vertical_beamwidth_rad, 0.2, 90, kDegrees);
  from.optional("tilt_deg", c.tilt_rad, -90, 90, kDegrees);
  read_scan(from, c.scan);
  from.optional("pulse_length_s", c.pulse.length_s, 1e-6, 20e-3);
  from.optional("most_samples", c.pulse.most_samples, 64, 20000);
  from.optional("source_level_db", c.source_level_db, -300, 250);
  from.optional("range_m", c.range_m, 0.5, 1000);
  from.optional("longest_range_m", c.longest_range_m, 0.5, 1000);
  if (c.range_m > c.longest_range_m) {
    from.problem("range_m", "is beyond longest_range_m, " + std::to_string(c.longest_range_m) + " m");
  }
  from.optional("ping_rate_hz", c.ping_rate_hz, 0.01, 200);
  from.optional("dead_time_s", c.dead_time_s, 0, 1);
  from.optional("processing_latency_s", c.processing_latency_s, 0, 10);
  from.optional("sound_speed_mps", c.sound_speed_mps, 1300, 1700);
  from.optional("electronic_noise_db", c.electronic_noise_db, -200, 150);
  from.optional("gain_spreading_db", c.gain_spreading_db, 0, 80);
  from.optional("gain_absorption_db_per_km", c.gain_absorption_dbpm, 0, 2000, kDecibelsPerKilometre);
  from.optional("gain_offset_db", c.gain_offset_db, -200, 200);
  read_converter(from, c.converter);
  read_quality(from, c.quality);
  read_trigger(from, c.trigger);
  c.interference = read_interference(from, scenario, process, c.processing_latency_s);
  read_effects(from, c.effects);
  c.world = scenario;
  c.process = process;
  c.mounting = read_mounting(from, scenario, process);
  return c;
}

bool ScanningConfig::operator==(const ScanningConfig& o) const {
  return frequency_hz == o.frequency_hz && horizontal_beamwidth_rad == o.horizontal_beamwidth_rad &&
         vertical_beamwidth_rad == o.vertical_beamwidth_rad && tilt_rad == o.tilt_rad && scan == o.scan &&
         pulse == o.pulse && source_level_db == o.source_level_db && range_m == o.range_m &&
         longest_range_m == o.longest_range_m && ping_rate_hz == o.ping_rate_hz && dead_time_s == o.dead_time_s &&
         processing_latency_s == o.processing_latency_s && sound_speed_mps == o.sound_speed_mps &&
         electronic_noise_db == o.electronic_noise_db && gain_spreading_db == o.gain_spreading_db &&
         gain_absorption_dbpm == o.gain_absorption_dbpm && gain_offset_db == o.gain_offset_db &&
         converter == o.converter && quality == o.quality && trigger == o.trigger && interference == o.interference &&
         effects == o.effects;
}

HeadSettings ScanningConfig::start() const {
  HeadSettings start;
  start.range_m = range_m;
  start.source_level_db = source_level_db;
  start.gain_spreading_db = effects.tvg ? gain_spreading_db : 0.0;
  start.gain_absorption_dbpm = effects.tvg ? gain_absorption_dbpm : 0.0;
  start.gain_offset_db = gain_offset_db;
  start.swath_rad = scan.width_rad;
  start.ping_rate_hz = ping_rate_hz;
  return start;
}

SettingLimits ScanningConfig::limits() const {
  SettingLimits limits;
  limits.range_m = {0.5, longest_range_m};
  limits.source_level_db = {source_level_db - kWeakest_db, source_level_db};
  if (effects.tvg) {
    limits.gain_spreading_db = {0.0, 80.0};
    limits.gain_absorption_dbpm = {0.0, 2.0};
  }
  limits.gain_offset_db = {-200.0, 200.0};
  limits.ping_rate_hz = {0.01, ping_rate_hz};
  return limits;
}

}  // namespace ensonify
