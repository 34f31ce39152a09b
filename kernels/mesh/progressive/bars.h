#pragma once

#include <span>
#include <vector>

#include "kernels/base/frames/attitude.h"
#include "kernels/mesh/progressive/mesh.h"

namespace ensonify::progressive {

/// Number of copies of a bar, itself included, and their spacing.
struct Repeat {
  int count = 1;
  frames::Vec3 step_m = frames::Vec3::Zero();
};

/// A straight solid of one section, closed at both ends: a pile, a fender, a step, the stringer or the rung of a
/// ladder. Round ones have kSides sides, whose edges lie on the circle: their middles lie 2 % of a radius inside it.
struct Bar {
  static constexpr int kSides = 16;
  frames::Vec3 from_m = frames::Vec3::Zero();
  frames::Vec3 to_m = frames::Vec3::Zero();
  double diameter_m = 0.0;  // of a round one; 0: `section_m`
  /// Section of a bar with corners. First how wide it is, level and across it, along x where it stands upright; then
  /// across both.
  frames::Vec2 section_m = frames::Vec2::Zero();
  std::vector<Repeat> repeat;  // a row, a grid, a lattice
};

/// Rings of vertices along a bar are so far apart, or less.
constexpr double kRing_m = 2.0;

/// Their vertices: what a mesh of them costs.
double vertices_of(std::span<const Bar> bars);

/// All of them. Where bars cross or touch, each keeps its own surface. Throws std::invalid_argument for a bar without
/// length or section, or repeated less than once.
TriangleMesh mesh_of(std::span<const Bar> bars);

}  // namespace ensonify::progressive
