#include "components/scanning/config.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "components/config/read_parameters.h"
#include "kernels/base/frames/attitude.h"

namespace ensonify {
namespace {

bool full_turn(const Scan& scan) { return scan.width_rad > 2.0 * std::numbers::pi - 1e-9; }

/// Strides that fit into the sector.
std::int64_t strides(const Scan& scan) {
  return std::max<std::int64_t>(1, static_cast<std::int64_t>(std::floor(scan.width_rad / stride_rad(scan) + 1e-6)));
}

/// Which place of the sector a ping points from.
std::int64_t place(const Scan& scan, std::int64_t ping) {
  const std::int64_t last = strides(scan);
  if (scan.reversing) {
    const std::int64_t there_and_back = ping % (2 * last);
    return there_and_back <= last ? there_and_back : 2 * last - there_and_back;
  }
  return ping % pings_per_sweep(scan);
}

}  // namespace

double stride_rad(const Scan& scan) { return scan.step_rad * scan.steps_per_ping; }

std::int64_t pings_per_sweep(const Scan& scan) {
  return full_turn(scan) && !scan.reversing ? strides(scan) : strides(scan) + 1;
}

double scan_angle_rad(const Scan& scan, std::int64_t ping) {
  const double from_rad = scan.centre_rad - 0.5 * scan.width_rad;
  return frames::wrap_pi(from_rad + static_cast<double>(place(scan, ping)) * stride_rad(scan));
}

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
