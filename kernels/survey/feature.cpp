#include "kernels/survey/feature.h"

#include <algorithm>
#include <cmath>

namespace ensonify::survey {

double ping_rate_hz(double range_m, double sound_speed_mps, double dead_s, double highest_hz) {
  return std::min(highest_hz, 1.0 / (2.0 * range_m / sound_speed_mps + dead_s));
}

double footprint_m(double depth_m, double along_width_rad) { return 2.0 * depth_m * std::tan(0.5 * along_width_rad); }

double fastest_for_feature_mps(double feature_m, double footprint_m, double rate_hz, int pings) {
  return (feature_m + footprint_m) * rate_hz / pings;
}

int soundings_across(double feature_m, double beam_spacing_m) {
  return static_cast<int>(std::floor(feature_m / beam_spacing_m + 1e-9));
}

}  // namespace ensonify::survey
