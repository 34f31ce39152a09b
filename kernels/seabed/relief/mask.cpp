#include "kernels/seabed/relief/mask.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "kernels/seabed/relief/spectral_surface.h"
#include "kernels/seabed/relief/window.h"

namespace ensonify::relief {
namespace {

/// 0 below -half, 1 above half.
float smooth_step(float x, float half) {
  if (half <= 0.0F) return x >= 0.0F ? 1.0F : 0.0F;
  const float u = std::clamp(0.5F + 0.5F * x / half, 0.0F, 1.0F);
  return u * u * (3.0F - 2.0F * u);
}

/// Calls at_node(west, east, south, north, here, spacing_m) with the heights around each node of a level.
template <class AtNode>
Field from_neighbours(Field height_m, double post_spacing_m, int level, AtNode at_node) {
  const auto at_level = [height_m = std::move(height_m), post_spacing_m, at_node](const Window& nodes,
                                                                                  std::span<float> out) {
    const Window wide{nodes.level, nodes.east - 1, nodes.north - 1, nodes.columns + 2, nodes.rows + 2};
    std::vector<float> z(wide.size());
    height_m(wide, z);
    const auto spacing_m = static_cast<float>(node_spacing_m(post_spacing_m, nodes.level));
    for (int j = 0; j < nodes.rows; ++j) {
      for (int i = 0; i < nodes.columns; ++i) {
        out[nodes.node(i, j)] = at_node(z[wide.node(i, j + 1)], z[wide.node(i + 2, j + 1)], z[wide.node(i + 1, j)],
                                        z[wide.node(i + 1, j + 2)], z[wide.node(i + 1, j + 1)], spacing_m);
      }
    }
  };
  return
      [level, at_level](const Window& window, std::span<float> out) { fill_from_level(level, at_level, window, out); };
}

/// Distance to the polygon's border, positive inside.
double depth_inside_m(const std::vector<frames::Vec2>& corners, const frames::Vec2& place) {
  bool inside = false;
  double nearest2 = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0, last = corners.size() - 1; i < corners.size(); last = i++) {
    const frames::Vec2 &a = corners[last], &b = corners[i];
    if ((a.y() > place.y()) != (b.y() > place.y()) &&
        place.x() < a.x() + (b.x() - a.x()) * (place.y() - a.y()) / (b.y() - a.y()))
      inside = !inside;
    nearest2 = std::min(nearest2, distance2_to_segment(place, a, b));
  }
  return inside ? std::sqrt(nearest2) : -std::sqrt(nearest2);
}

}  // namespace

Field in_band(Field quantity, const Band& band) {
  if (!(band.low <= band.high && band.softness >= 0.0))
    throw std::invalid_argument("mask: the band's low limit must not exceed the high one, nor softness be negative");
  const auto low = static_cast<float>(band.low), high = static_cast<float>(band.high);
  const auto half = static_cast<float>(0.5 * band.softness);
  return [quantity = std::move(quantity), low, high, half](const Window& window, std::span<float> out) {
    quantity(window, out);
    for (float& x : out) x = smooth_step(x - low, half) * smooth_step(high - x, half);
  };
}

Field outside(Field mask) {
  return [mask = std::move(mask)](const Window& window, std::span<float> out) {
    mask(window, out);
    for (float& x : out) x = 1.0F - x;
  };
}

Field slope_of(Field height_m, double post_spacing_m, int level) {
  return from_neighbours(std::move(height_m), post_spacing_m, level,
                         [](float west, float east, float south, float north, float, float spacing_m) {
                           const float x = (east - west) / (2.0F * spacing_m), y = (north - south) / (2.0F * spacing_m);
                           return std::sqrt(x * x + y * y);
                         });
}

Field curvature_of(Field height_m, double post_spacing_m, int level) {
  return from_neighbours(std::move(height_m), post_spacing_m, level,
                         [](float west, float east, float south, float north, float here, float spacing_m) {
                           const float laplacian = (west - here) + (east - here) + (south - here) + (north - here);
                           return 0.5F * laplacian / (spacing_m * spacing_m);
                         });
}

Field in_polygon(std::vector<frames::Vec2> corners_enu_m, double softness_m, double post_spacing_m) {
  if (corners_enu_m.size() < 3 || !(softness_m >= 0.0))
    throw std::invalid_argument("mask: a polygon needs three corners or more, and a softness of 0 or more");
  return [corners = std::move(corners_enu_m), softness_m, post_spacing_m](const Window& window, std::span<float> out) {
    const auto half = static_cast<float>(0.5 * softness_m);
    const frames::Vec2 first = place_enu_m(window, 0, 0, post_spacing_m),
                       last = place_enu_m(window, window.columns - 1, window.rows - 1, post_spacing_m);
    const double at_centre_m = depth_inside_m(corners, 0.5 * (first + last));
    if (std::abs(at_centre_m) > 0.5 * (last - first).norm() + 0.5 * softness_m) {  // the border is not here
      std::fill(out.begin(), out.end(), at_centre_m > 0.0 ? 1.0F : 0.0F);
      return;
    }
    for (int j = 0; j < window.rows; ++j) {
      for (int i = 0; i < window.columns; ++i) {
        const double inside_m = depth_inside_m(corners, place_enu_m(window, i, j, post_spacing_m));
        out[window.node(i, j)] = smooth_step(static_cast<float>(inside_m), half);
      }
    }
  };
}

}  // namespace ensonify::relief
