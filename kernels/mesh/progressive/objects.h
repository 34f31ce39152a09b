#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "kernels/base/frames/attitude.h"
#include "kernels/base/random/stream.h"
#include "kernels/mesh/progressive/hierarchy.h"

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

/// A quay wall of steel U piles: pans that stand in and out in turn, with inclined webs between. Dimensions as of PU 18
/// [ArcelorMittal2013], whose pans and webs take about as much of the width each.
struct SheetPileWall {
  frames::Vec2 from_enu_m = frames::Vec2::Zero();
  frames::Vec2 to_enu_m{100.0, 0.0};
  double foot_depth_m = 15.0;     // below chart datum: in the seabed
  double top_height_m = 0.0;      // above it
  double pile_width_m = 0.6;      // from interlock to interlock, along the wall
  double profile_depth_m = 0.43;  // across the wall, from pan to pan
  double out_of_line_m = 0.015;   // standard deviation of a pile's place across the wall
  double row_m = 1.0;             // vertices up a pile are so far apart, or less
};

/// Its vertices: what a mesh of it costs.
double vertices_of(const SheetPileWall& wall);

/// The surface, without thickness. The last pile ends where the wall does, or a little before. Throws
/// std::invalid_argument for a wall shorter than a pile, of no height, or with a width, row or depth that is not
/// positive.
TriangleMesh mesh_of(const SheetPileWall& wall, const random::Stream& stream);

/// Pose of a copy of a mesh: its origin's place, its y axis from north, its size.
struct Copy {
  frames::Vec3 position_enu_m = frames::Vec3::Zero();
  double heading_rad = 0.0;
  double scale = 1.0;
};

/// Copies strewn over a rectangle: about the line between two places, as wide to either side. Number above a size goes
/// as size^-exponent from the least to the most, as that of boulders does (kernels/seabed/relief/bodies.h).
struct Strewn {
  frames::Vec2 from_enu_m = frames::Vec2::Zero();
  frames::Vec2 to_enu_m{1.0, 0.0};
  double width_m = 1.0;  // of the rectangle, across the line
  double least_scale = 1.0, most_scale = 1.0;
  double size_exponent = 2.0;
};

/// Copy number n of endlessly many, its height 0: a function of the stream and n alone. Throws std::invalid_argument
/// for scales that are not above 0 and rising, an exponent that is not above 0, or a negative width.
Copy drawn(const Strewn& strewn, const random::Stream& stream, std::uint64_t n);

/// A mesh as often as there are copies, as one. Each copy has the splits of the original, in a block of their own; a
/// copy of another size deviates by so much more or less. An empty list gives a mesh without triangles.
Hierarchy copies_of(const Hierarchy& one, std::span<const Copy> copies);

}  // namespace ensonify::progressive
