#include "kernels/seabed/relief/shapes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "kernels/seabed/relief/window.h"

namespace ensonify::relief {
namespace {

using frames::Vec2;

template <class Height>
Field field_of(double post_spacing_m, Height height_m) {
  return [post_spacing_m, height_m](const Window& window, std::span<float> out) {
    for (int j = 0; j < window.rows; ++j) {
      for (int i = 0; i < window.columns; ++i)
        out[window.node(i, j)] = static_cast<float>(height_m(place_enu_m(window, i, j, post_spacing_m)));
    }
  };
}

Vec2 along(double heading_rad) { return {std::sin(heading_rad), std::cos(heading_rad)}; }

void require_positive(const char* what, double value) {
  if (!(value > 0.0))
    throw std::invalid_argument(std::string("shape: ") + what + " is " + std::to_string(value) + ", allowed: above 0");
}

}  // namespace

Field plane(const Plane& shape, double post_spacing_m) {
  const Vec2 fall = shape.slope * along(shape.downhill_heading_rad);
  return field_of(post_spacing_m, [shape, fall](const Vec2& place) { return -shape.depth_m - place.dot(fall); });
}

Field ramp(const Ramp& shape, double post_spacing_m) {
  if (!(shape.run_m >= 0.0)) throw std::invalid_argument("shape: run_m is negative, allowed: 0 or more");
  const Vec2 ahead = along(shape.heading_rad);
  return field_of(post_spacing_m, [shape, ahead](const Vec2& place) {
    const double past_m = (place - shape.middle_enu_m).dot(ahead);
    const double share = shape.run_m > 0.0 ? std::clamp(past_m / shape.run_m + 0.5, 0.0, 1.0)
                         : past_m >= 0.0   ? 1.0
                                           : 0.0;
    return -shape.depth_m - share * shape.drop_m;
  });
}

Field wave(const Wave& shape, double post_spacing_m) {
  require_positive("wavelength_m", shape.wavelength_m);
  const Vec2 per_m = 2.0 * std::numbers::pi / shape.wavelength_m * along(shape.heading_rad);
  return field_of(post_spacing_m, [shape, per_m](const Vec2& place) {
    return -shape.depth_m + shape.amplitude_m * std::cos(place.dot(per_m));
  });
}

Field sphere(const Sphere& shape, double post_spacing_m) {
  require_positive("radius_m", shape.radius_m);
  return field_of(post_spacing_m, [shape](const Vec2& place) {
    const double up2 = shape.radius_m * shape.radius_m - (place - shape.centre_enu_m).squaredNorm();
    const double top_m = up2 > 0.0 ? -shape.centre_depth_m + std::sqrt(up2) : -shape.depth_m;
    return std::max(-shape.depth_m, top_m);
  });
}

Field ridge(const Ridge& shape, double post_spacing_m) {
  require_positive("width_m", shape.width_m);
  return field_of(post_spacing_m, [shape](const Vec2& place) {
    const double distance2 = distance2_to_segment(place, shape.start_enu_m, shape.end_enu_m);
    // Beyond four widths it is 2^-64 of its height.
    return distance2 > 16.0 * shape.width_m * shape.width_m
               ? 0.0
               : shape.height_m * std::exp(-4.0 * std::numbers::ln2 * distance2 / (shape.width_m * shape.width_m));
  });
}

}  // namespace ensonify::relief
