#pragma once

#include <vector>

#include "kernels/base/frames/attitude.h"

/// Heights above chart datum as instruments give them.
namespace ensonify::vertical {

/// Height of one reference surface above another over the world: one value, or a grid.
class Separation {
 public:
  Separation() = default;
  explicit Separation(double constant_m) : constant_m_(constant_m) {}
  /// A grid by rows from south to north, bilinear between its posts; outside it the nearest edge. Throws
  /// std::invalid_argument unless it has 2 x 2 posts or more, a spacing above 0 and finite values.
  Separation(const frames::Vec2& south_west_enu_m, double spacing_m, std::size_t columns, std::size_t rows,
             std::vector<double> values_m);

  double at(const frames::Vec2& place_enu_m) const;

  /// Whether a place lies on a cell of the grid, whose cells reach half a spacing beyond their posts. A constant is
  /// everywhere.
  bool covers(const frames::Vec2& place_enu_m) const;

 private:
  double constant_m_ = 0.0;
  frames::Vec2 south_west_enu_m_ = frames::Vec2::Zero();
  double spacing_m_ = 0.0;
  std::size_t columns_ = 0, rows_ = 0;
  std::vector<double> values_m_;  // empty: constant
};

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
