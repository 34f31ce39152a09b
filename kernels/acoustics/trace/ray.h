#pragma once

#include <Eigen/Core>

namespace ensonify::trace {

/// A bundle of sound around one direction. The direction is unit length. The solid angles of the rays that are spread
/// over a transmission's volume sum to that of the volume; those to facets of small objects stand for the facets.
struct Ray {
  Eigen::Vector3f direction_head = Eigen::Vector3f::UnitZ();  // head frame, FRD
  float solid_angle_sr = 0.0F;
};

}  // namespace ensonify::trace
