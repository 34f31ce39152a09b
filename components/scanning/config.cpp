#include "components/scanning/config.h"

#include "components/config/read_parameters.h"

namespace ensonify {
ScanningConfig ScanningConfig::read(ConfigReader& from, const World& world, const std::string& process) {
  ScanningConfig c;
  read_parameters(from, c);
  c.pulse.check(from);
  if (stride_rad(c.scan) > c.scan.width_rad) {
    from.problem("sector_width_deg", "is less than what the head turns between two pings");
  }
  if (c.range_m > c.longest_range_m) {
    from.problem("range_m", "is beyond longest_range_m, " + std::to_string(c.longest_range_m) + " m");
  }
  place_head(from, world, process, c);
  return c;
}

HeadSettings ScanningConfig::start() const {
  HeadSettings start = start_at(range_m, source_level_db);
  start.swath_rad = scan.width_rad;
  return start;
}

SettingLimits ScanningConfig::limits() const {
  SettingLimits limits = limits_up_to(0.5, longest_range_m, source_level_db);
  allow_held_pulses(pulse, sound_speed_mps, limits);
  limits["swath_rad"] = {{stride_rad(scan), 360.0 * Scan::kDegree}};
  return limits;
}

}  // namespace ensonify
