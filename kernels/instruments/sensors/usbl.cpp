#include "kernels/instruments/sensors/usbl.h"

#include <algorithm>
#include <cmath>

namespace ensonify::sensors {

double off_axis_rad(const frames::Vec3& place_array_m) {
  return std::atan2(place_array_m.head<2>().norm(), place_array_m.z());
}

std::optional<UsblReading> locate(const UsblErrors& errors, const frames::Vec3& true_array_m,
                                  const random::Stream& stream, std::uint64_t n) {
  enum Lane : std::uint64_t { kRange, kAngles, kOutlier, kReflection };
  const double range_m = true_array_m.norm();
  if (range_m <= 0.0 || range_m > errors.longest_m) return std::nullopt;
  const double cos_off = true_array_m.z() / range_m;
  if (cos_off < std::cos(errors.widest_rad)) return std::nullopt;

  // Direction sines are what a flat array measures: their noise is the same everywhere.
  const auto angles = stream.normal_pair(n, kAngles);
  double u = true_array_m.x() / range_m + errors.bearing_white_rad * angles[0];
  double v = true_array_m.y() / range_m + errors.bearing_white_rad * angles[1];
  double measured_m = range_m * (1.0 + errors.sound_speed_scale) + errors.range_white_m * stream.normal(n, kRange);
  if (stream.uniform(n, kOutlier) < errors.outlier) {  // by way of the surface: longer, and from elsewhere
    measured_m *= 1.0 + stream.uniform(n, kReflection);
    u = -u;
  }
  const double sines = std::hypot(u, v);
  if (sines > 1.0) u /= sines, v /= sines;
  const double w = std::sqrt(std::max(0.0, 1.0 - u * u - v * v));

  UsblReading reading;
  reading.place_array_m = measured_m * frames::Vec3(u, v, w);
  const double across_m = range_m * errors.bearing_white_rad;
  const double tan_off = std::sqrt(std::max(0.0, 1.0 - cos_off * cos_off)) / std::max(cos_off, 0.05);
  reading.sigma_array_m = {std::hypot(across_m, errors.range_white_m * u),
                           std::hypot(across_m, errors.range_white_m * v),
                           std::hypot(across_m * tan_off, errors.range_white_m * w)};
  reading.age_s = range_m / errors.speed_of_sound_mps;
  return reading;
}

}  // namespace ensonify::sensors
