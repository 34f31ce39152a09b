#include "kernels/vertical/reduction.h"

namespace ensonify::vertical {
namespace {

double datum_above_ellipsoid_m(const Datums& datums, const frames::Vec2& place_enu_m) {
  return datums.geoid_above_ellipsoid.at(place_enu_m) + datums.datum_above_geoid.at(place_enu_m);
}

}  // namespace

double ellipsoid_height_m(const Datums& datums, const frames::Vec3& point_enu_m) {
  return point_enu_m.z() + datum_above_ellipsoid_m(datums, point_enu_m.head<2>());
}

double geoid_height_m(const Datums& datums, const frames::Vec3& point_enu_m) {
  return point_enu_m.z() + datums.datum_above_geoid.at(point_enu_m.head<2>());
}

double depth_below_water_m(const frames::Vec3& point_enu_m, double water_level_m) {
  return water_level_m - point_enu_m.z();
}

double reduced_by_gauge_m(double below_transducer_m, double transducer_below_water_m, double heave_m, double tide_m) {
  return below_transducer_m + transducer_below_water_m - heave_m - tide_m;
}

double reduced_by_ellipsoid_m(double below_transducer_m, double antenna_ellipsoid_height_m,
                              double antenna_above_transducer_m, const Datums& datums,
                              const frames::Vec2& place_enu_m) {
  const double transducer_m =
      antenna_ellipsoid_height_m - antenna_above_transducer_m - datum_above_ellipsoid_m(datums, place_enu_m);
  return below_transducer_m - transducer_m;
}

}  // namespace ensonify::vertical
