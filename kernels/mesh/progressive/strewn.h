#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "kernels/base/random/stream.h"
#include "kernels/mesh/progressive/hierarchy.h"

namespace ensonify::progressive {

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
