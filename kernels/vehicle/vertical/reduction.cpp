#include "kernels/vehicle/vertical/reduction.h"

namespace ensonify::vertical {

double geoid_height_m(const Datums& datums, const frames::Vec3& point_enu_m) {
  return point_enu_m.z() + datums.datum_above_geoid.at(point_enu_m.head<2>());
}

double depth_below_water_m(const frames::Vec3& point_enu_m, double water_level_m) {
  return water_level_m - point_enu_m.z();
}

}  // namespace ensonify::vertical
