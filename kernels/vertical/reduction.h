#pragma once

#include "kernels/vertical/separation.h"

/// From what instruments measure to heights above chart datum, and back.
namespace ensonify::vertical {

/// The three surfaces that heights refer to. World zero is chart datum.
struct Datums {
  Separation geoid_above_ellipsoid;  // the undulation N
  Separation datum_above_geoid;      // chart datum above the geoid; where it lies below, negative
};

/// Height above the WGS 84 ellipsoid of a point of the world.
double ellipsoid_height_m(const Datums& datums, const frames::Vec3& point_enu_m);

/// Height above the geoid, which is what a GGA sentence carries (its undulation beside it).
double geoid_height_m(const Datums& datums, const frames::Vec3& point_enu_m);

/// Depth below the water's surface, which is what a pressure sensor is calibrated to.
double depth_below_water_m(const frames::Vec3& point_enu_m, double water_level_m);

/// Depth below chart datum of a sounding, by tide gauge: the depth below the transducer, plus how deep that is below
/// the water (draught, sinkage, and without heave), less the tide.
double reduced_by_gauge_m(double below_transducer_m, double transducer_below_water_m, double heave_m, double tide_m);

/// The same by satellite: depth below the transducer less its height above datum, from the antenna's ellipsoid height
/// and its height above the transducer (along the vertical).
double reduced_by_ellipsoid_m(double below_transducer_m, double antenna_ellipsoid_height_m,
                              double antenna_above_transducer_m, const Datums& datums, const frames::Vec2& place_enu_m);

}  // namespace ensonify::vertical
