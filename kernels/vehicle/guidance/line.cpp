#include "kernels/vehicle/guidance/line.h"

#include <algorithm>
#include <cmath>

namespace ensonify::guidance {

LineGains line_gains(double speed_mps, double lag_s, double least_lookahead_m, double damping) {
  LineGains gains;
  gains.lookahead_m = std::max(least_lookahead_m, 10.0 * lag_s * speed_mps);
  gains.integral_mps = speed_mps / (4.0 * damping * damping);
  // Enough for a current of nine tenths of the speed: sigma y / lookahead = 0.9 / sqrt(1 - 0.9^2) = 2.06.
  gains.most_integral_s = 2.06 * gains.lookahead_m / gains.integral_mps;
  return gains;
}

double course_offset_rad(const LineGains& gains, double cross_track_m, double integral_s) {
  return -std::atan2(cross_track_m + gains.integral_mps * integral_s, gains.lookahead_m);
}

double next_integral_s(const LineGains& gains, double cross_track_m, double integral_s, double dt_s) {
  const double aim_m = cross_track_m + gains.integral_mps * integral_s;
  const double rate = gains.lookahead_m * cross_track_m / (aim_m * aim_m + gains.lookahead_m * gains.lookahead_m);
  return std::clamp(integral_s + rate * dt_s, -gains.most_integral_s, gains.most_integral_s);
}

}  // namespace ensonify::guidance
