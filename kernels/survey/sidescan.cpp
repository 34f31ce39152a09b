#include "kernels/survey/sidescan.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ensonify::survey {

SidescanSwath sidescan_swath(double altitude_m, double range_m, double nadir_half_angle_rad) {
  return {altitude_m * std::tan(nadir_half_angle_rad), std::sqrt(range_m * range_m - altitude_m * altitude_m),
          std::asin(altitude_m / range_m)};
}

double joining_spacing_m(const SidescanSwath& swath, double overlap) { return 2.0 * swath.far_m * (1.0 - overlap); }

double gap_filling_spacing_m(const SidescanSwath& swath, double overlap) {
  return (swath.far_m - swath.near_m) * (1.0 - overlap);
}

double towfish_altitude_m(double range_m, double share, double least_m) { return std::max(share * range_m, least_m); }

double shadow_m(double object_m, double altitude_m, double ground_range_m) {
  return object_m < altitude_m ? object_m * ground_range_m / (altitude_m - object_m)
                               : std::numeric_limits<double>::infinity();
}

}  // namespace ensonify::survey
