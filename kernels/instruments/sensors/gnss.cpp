#include "kernels/instruments/sensors/gnss.h"

#include <algorithm>
#include <cmath>

namespace ensonify::sensors {
namespace {

enum Lane : std::uint64_t { kEast, kNorth, kUp, kDilution, kWhite };

}  // namespace

Gnss::Gnss(const GnssErrors& errors, const random::Stream& stream)
    : errors_(errors),
      stream_(stream),
      east_(1.0, errors.wander_s, stream, kEast),
      north_(1.0, errors.wander_s, stream, kNorth),
      up_(1.0, errors.wander_s, stream, kUp),
      dilution_(1.0, errors.hdop_wander_s, stream, kDilution),
      received_s_(errors.first_fix_s + errors.converge_s) {}  // the receiver has been on for long

GnssReading Gnss::measure(double antenna_above_water_m, bool jammed, double dt_s) {
  if (n_++ > 0) {
    east_.advance(dt_s, stream_, n_, kEast);
    north_.advance(dt_s, stream_, n_, kNorth);
    up_.advance(dt_s, stream_, n_, kUp);
    dilution_.advance(dt_s, stream_, n_, kDilution);
    received_s_ += dt_s;
  }
  if (jammed || antenna_above_water_m < errors_.washed_depth_m) received_s_ = 0.0;
  constexpr double kRounding_s = 1e-9;
  if (received_s_ < errors_.first_fix_s - kRounding_s || received_s_ == 0.0) return {};

  const bool best = received_s_ >= errors_.first_fix_s + errors_.converge_s - kRounding_s;
  const FixErrors& e = best ? errors_.fix : errors_.degraded;
  GnssReading reading;
  reading.quality = best ? errors_.best : errors_.while_degraded;
  reading.hdop = errors_.hdop * std::max(0.5, 1.0 + errors_.hdop_wander * dilution_.value());
  const frames::Vec3 white(e.horizontal_m * stream_.normal(n_, kWhite), e.horizontal_m * stream_.normal(n_, kWhite + 1),
                           e.vertical_m * stream_.normal(n_, kWhite + 2));
  const frames::Vec3 slow(e.wander_horizontal_m * east_.value(), e.wander_horizontal_m * north_.value(),
                          e.wander_vertical_m * up_.value());
  reading.error_enu_m = reading.hdop * (white + slow);
  const double horizontal = reading.hdop * std::hypot(e.horizontal_m, e.wander_horizontal_m);
  reading.sigma_enu_m = {horizontal, horizontal, reading.hdop * std::hypot(e.vertical_m, e.wander_vertical_m)};
  return reading;
}

double off_axis_rad(const frames::Vec3& place_array_m) {
  return std::atan2(place_array_m.head<2>().norm(), place_array_m.z());
}

std::optional<UsblReading> locate(const UsblErrors& errors, const frames::Vec3& true_array_m,
                                  const random::Stream& stream, std::uint64_t n) {
  enum : std::uint64_t { kRange, kAngles, kOutlier, kReflection };
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
