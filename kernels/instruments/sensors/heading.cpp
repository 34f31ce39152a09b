#include "kernels/instruments/sensors/heading.h"

#include <cmath>

namespace ensonify::sensors {

double Deviation::at(double heading_rad) const {
  const auto& [a_rad, b_rad, c_rad, d_rad, e_rad] = abcde_rad;
  return a_rad + b_rad * std::sin(heading_rad) + c_rad * std::cos(heading_rad) + d_rad * std::sin(2.0 * heading_rad) +
         e_rad * std::cos(2.0 * heading_rad);
}

double steaming_error_rad(double speed_north_mps, double latitude_rad) {
  constexpr double kEarthSpeed_mps = 6378137.0 * 7.292115e-5;  // of the ground at the equator
  return -std::atan2(speed_north_mps, kEarthSpeed_mps * std::cos(latitude_rad));
}

double HeadingSensor::measure(double heading_rad, double speed_north_mps, double latitude_rad, double dt_s) {
  unwrapped_rad_ += frames::wrap_pi(heading_rad - unwrapped_rad_);
  double reading = sensor_.measure(unwrapped_rad_, dt_s);
  if (errors_.kind == HeadingKind::kMagnetic) {
    reading += errors_.deviation.at(heading_rad) + errors_.variation_error_rad;
  } else if (!errors_.speed_corrected) {
    reading += steaming_error_rad(speed_north_mps, latitude_rad);
  }
  return frames::wrap_two_pi(reading);
}

}  // namespace ensonify::sensors
