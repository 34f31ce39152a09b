#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "kernels/base/frames/attitude.h"
#include "kernels/base/random/stream.h"
#include "kernels/seabed/relief/window.h"

namespace ensonify::relief {

enum class BodyShape {
  kBoulder,   // half an ellipsoid: height sqrt(1 - u^2), u the distance from the middle over the radius
  kMound,     // height (1 - u^2)^2: coral mounds, spoil heaps
  kPockmark,  // -height (1 - u^2)^2
};

/// Boulders, cobble fields, coral mounds, pockmarks: bodies strewn at random, a Poisson process in the plane.
struct BodyParameters {
  BodyShape shape = BodyShape::kBoulder;
  double per_km2 = 0.0;            // of the smallest radius and above, where the mask is 1
  double smallest_radius_m = 0.5;  // > 0
  double largest_radius_m = 2.0;   // >= smallest
  double size_exponent = 3.0;      // number above radius r goes as r^-exponent, up to the largest; > 0
  double height_per_radius = 0.8;  // mean
  double height_ln_sd = 0.0;       // of ln(height per radius)
  double elongation = 1.0;         // longer over shorter half axis at most; 1: round. Area stays
};

struct Body {
  frames::Vec2 centre_enu_m;
  double radius_m = 0.0;  // of the circle of the same area
  double height_m = 0.0;  // negative: depth of a pockmark
  double elongation = 1.0;
  frames::Vec2 longer_axis_enu = frames::Vec2::UnitY();
};

/// Rule for bodies that overlap: the one that departs most from the bottom is seen. Bodies of which a node of `mask`
/// (the south-west one of the cell of about two largest radii in which they lie) says less than a random number do not
/// exist. At level k bodies are seen at its nodes, unless they are smaller in radius than the nodes are apart.
class Bodies {
 public:
  Bodies(const BodyParameters& parameters, double post_spacing_m, std::uint64_t seed, std::string_view name,
         Field mask = nullptr);

  /// Height above (or below) the surrounding bottom, m; 0 where there is none.
  void fill(const Window& window, std::span<float> height_m) const;

  /// All bodies that reach into a rectangle.
  std::vector<Body> within(const frames::Vec2& south_west_enu_m, const frames::Vec2& north_east_enu_m) const;

 private:
  void add_cell(std::int64_t east, std::int64_t north, float mask, std::vector<Body>& bodies) const;

  BodyParameters parameters_;
  double post_spacing_m_;
  int cell_level_ = 0;   // cells are the lattice of this level
  double per_cell_ = 0;  // expected number
  double reach_m_ = 0;
  random::Stream noise_;
  Field mask_;
};

/// Height of a body at a place, m; 0 beyond its edge.
double height_at_m(const Body& body, BodyShape shape, const frames::Vec2& place_enu_m);

}  // namespace ensonify::relief
