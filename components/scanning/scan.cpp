#include "components/scanning/scan.h"

#include <algorithm>
#include <cmath>
#include <numbers>

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

}  // namespace ensonify
