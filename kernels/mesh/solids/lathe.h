#pragma once

#include <vector>

#include "kernels/mesh/solids/solid.h"

namespace ensonify::solids {

/// A piece of an outline in the half plane of radius and height, between two points of it, with the outward normals
/// there. Where the normals differ the piece stands for a curve.
struct OutlinePiece {
  frames::Vec2 from_m, to_m;
  frames::Vec2 normal_from, normal_to;
};

/// Outlines: what they bound lies to the left of the way along them.
class Outline {
 public:
  explicit Outline(const frames::Vec2& start_m) : here_m_(start_m) {}

  Outline& straight_to(const frames::Vec2& to_m);
  /// Round a centre by an angle, counterclockwise, in pieces that leave the arc by no more than `sagitta_m`.
  Outline& arc(const frames::Vec2& centre_m, double by_rad, double sagitta_m);
  /// Ends where it began, straight unless it is there but for rounding.
  Outline& close();
  /// The last point is this one, which it is but for rounding.
  Outline& end_at(const frames::Vec2& point_m);

  const std::vector<OutlinePiece>& pieces() const { return pieces_; }

 private:
  frames::Vec2 here_m_;
  std::vector<OutlinePiece> pieces_;
};

/// What an outline bounds when it is turned about the z axis, of which it begins and ends, or which closes on itself:
/// triangles that leave the surface by no more than `sagitta_m` round the axis, and bulge onto it. Throws as
/// surface_of.
Surface turned(const Outline& outline, double sagitta_m);

/// The same, laid down: its axis along y, with what was up to the north.
Surface laid_down(Surface upright);

}  // namespace ensonify::solids
