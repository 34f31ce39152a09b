#pragma once

#include "kernels/vehicle/vertical/separation.h"

/// Heights above chart datum as instruments give them.
namespace ensonify::vertical {

/// The three surfaces that heights refer to. World zero is chart datum.
struct Datums {
  Separation geoid_above_ellipsoid;  // the undulation N
  Separation datum_above_geoid;      // chart datum above the geoid; where it lies below, negative
};

/// Height above the geoid, which is what a GGA sentence carries (its undulation beside it).
double geoid_height_m(const Datums& datums, const frames::Vec3& point_enu_m);

/// Depth below the water's surface, which is what a pressure sensor is calibrated to.
double depth_below_water_m(const frames::Vec3& point_enu_m, double water_level_m);

}  // namespace ensonify::vertical
