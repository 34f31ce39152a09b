#pragma once

#include <cstdint>

namespace ensonify {

/// Rotation of a mechanically scanned head's transducer about the head's z axis. Angles from the x axis, positive to
/// starboard.
struct Scan {
  double centre_rad = 0.0;
  double width_rad = 360.0 * kDegree;  // of the sector; from 360 degrees on it turns without an end
  double step_rad = 0.9 * kDegree;
  int steps_per_ping = 1;
  bool reversing = false;  // back and forth; else always to starboard, and from the sector's end back to its start

  bool operator==(const Scan&) const = default;
  static constexpr double kDegree = 3.14159265358979323846 / 180.0;
};

/// Turned between two pings.
double stride_rad(const Scan& scan);

/// Pings from one end of the sector to the other; in a full turn, pings of the turn. At least 1.
std::int64_t pings_per_sweep(const Scan& scan);

/// Angle of the transducer at a ping, -pi..pi; the first is the sector's port end.
double scan_angle_rad(const Scan& scan, std::int64_t ping);

}  // namespace ensonify
