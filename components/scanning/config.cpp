#include "components/scanning/config.h"

#include "components/config/config_reader.h"
#include "components/sonar/line_shading.h"

namespace ensonify {
namespace {

constexpr double kFastest_hz = 200.0;

void read_scan(ConfigReader& from, Scan& scan) {
  from.optional("sector_centre_deg", scan.centre_rad, -180, 180, kDegrees);
  from.optional("sector_width_deg", scan.width_rad, 0.1, 360, kDegrees);
  from.optional("step_deg", scan.step_rad, 0.05, 30, kDegrees);
  from.optional("steps_per_ping", scan.steps_per_ping, 1, 100);
  from.optional_choice("turning", scan.reversing, {{"continuous", false}, {"reversing", true}});
  if (stride_rad(scan) > scan.width_rad) {
    from.problem("sector_width_deg", "is less than what the head turns between two pings");
  }
}

}  // namespace

ScanningConfig ScanningConfig::read(ConfigReader& from, const World& world, const std::string& process) {
  ScanningConfig c;
  from.optional("frequency_hz", c.frequency_hz, 50e3, 3e6);
  from.optional("horizontal_beamwidth_deg", c.horizontal_beamwidth_rad, 0.2, 20, kDegrees);
  read_shading(from, "shading", c.shading);
  from.optional("vertical_beamwidth_deg", c.vertical_beamwidth_rad, 0.2, 90, kDegrees);
  from.optional("tilt_deg", c.tilt_rad, -90, 90, kDegrees);
  read_scan(from, c.scan);
  read_pulse(from, c.pulse);
  from.optional("source_level_db", c.source_level_db, -300, 250);
  from.optional("range_m", c.range_m, 0.5, 1000);
  from.optional("longest_range_m", c.longest_range_m, 0.5, 1000);
  if (c.range_m > c.longest_range_m) {
    from.problem("range_m", "is beyond longest_range_m, " + std::to_string(c.longest_range_m) + " m");
  }
  from.optional("electronic_noise_db", c.electronic_noise_db, -200, 150);
  read_head(from, world, process, kFastest_hz, c);
  read_sound_speed(from, c);
  return c;
}

bool ScanningConfig::operator==(const ScanningConfig& o) const {
  return same_parameters(*this, o) && sound_speed_mps == o.sound_speed_mps && frequency_hz == o.frequency_hz &&
         horizontal_beamwidth_rad == o.horizontal_beamwidth_rad && shading == o.shading &&
         vertical_beamwidth_rad == o.vertical_beamwidth_rad && tilt_rad == o.tilt_rad && scan == o.scan &&
         pulse == o.pulse && source_level_db == o.source_level_db && range_m == o.range_m &&
         longest_range_m == o.longest_range_m && electronic_noise_db == o.electronic_noise_db;
}

HeadSettings ScanningConfig::start() const {
  HeadSettings start = start_at(range_m, source_level_db);
  start.swath_rad = scan.width_rad;
  return start;
}

SettingLimits ScanningConfig::limits() const {
  SettingLimits limits = limits_up_to(0.5, longest_range_m, source_level_db);
  allow_held_pulses(pulse, sound_speed_mps, limits);
  limits.swath_rad = {stride_rad(scan), 360.0 * Scan::kDegree};
  return limits;
}

}  // namespace ensonify
