#pragma once

#include <Eigen/Core>

namespace ensonify::trace {

/// A bundle of sound around one direction. The direction is unit length; the solid angles of the rays of a transmission
/// sum to that of its volume.
struct Ray {
  Eigen::Vector3f direction_head = Eigen::Vector3f::UnitZ();  // head frame, FRD
  float solid_angle_sr = 0.0F;
};

}  // namespace ensonify::trace
