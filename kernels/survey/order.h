#pragma once

#include <cmath>

namespace ensonify::survey {

/// Uncertainty that an order of S-44 allows a sounding, at 95 % [S44]: vertically sqrt(a^2 + (b depth)^2),
/// horizontally a radius and a share of the depth. And the side of the cubes that its full feature search must find: a
/// length, below some depth a share of the depth.
struct SurveyOrder {
  double a_m, b;
  double radius_m, radius_share;
  double cube_m, deep_from_m, deep_cube_share;
};

inline constexpr SurveyOrder kSpecialOrder{0.25, 0.0075, 2.0, 0.0, 1.0, INFINITY, 0.0};
inline constexpr SurveyOrder kOrder1a{0.5, 0.013, 5.0, 0.05, 2.0, 40.0, 0.1};

/// Whether a sounding's total vertical and horizontal uncertainty are within the order's, at a depth >= 0.
inline bool meets(const SurveyOrder& order, double depth_m, double tvu_m, double thu_m) {
  return tvu_m <= std::hypot(order.a_m, order.b * depth_m) && thu_m <= order.radius_m + order.radius_share * depth_m;
}

/// Side of the cubes to be found at a depth >= 0.
inline double cube_m(const SurveyOrder& order, double depth_m) {
  return depth_m > order.deep_from_m ? order.deep_cube_share * depth_m : order.cube_m;
}

}  // namespace ensonify::survey
