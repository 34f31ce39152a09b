#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "kernels/mesh/solids/solid.h"

/// How a body lies on uneven ground.
namespace ensonify::solids {

/// Centre of mass of what a closed mesh holds, of even density, in the mesh's frame; of one without volume, of its
/// area.
frames::Vec3 centre_of_mass(const progressive::TriangleMesh& mesh);

/// Places of a surface that may touch the ground: none is farther from the next one than about `apart_m`.
std::vector<frames::Vec3> places_of(const Surface& surface, double apart_m);

/// Ground heights on a grid of equal spacing, straight between its posts in each direction.
struct GroundPatch {
  frames::Vec2 corner_m = frames::Vec2::Zero();  // of the first post: south-west
  double spacing_m = 1.0;
  Eigen::MatrixXd height_m;  // row: north, column: east

  double at(const frames::Vec2& place_m) const;
};

/// A pose on the ground: the turn from the body's frame, and how high its origin is.
struct Rest {
  Eigen::Matrix3d turn;
  double height_m = 0.0;
};

/// The pose in which a body lies in balance at a position, found from `upright` downhill: no small tilt brings its
/// centre of mass lower while it stays on the ground, so that the centre is above the hull of its contacts. It touches
/// the ground with at least one of its places and is below it with none. It does not slide, and does not turn about
/// the vertical. Within 0.01 degrees.
Rest at_rest(std::span<const frames::Vec3> places_m, const frames::Vec3& centre_m, const Eigen::Matrix3d& upright,
             const frames::Vec2& position_m, const GroundPatch& ground);

}  // namespace ensonify::solids
