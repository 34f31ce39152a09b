#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "kernels/mesh/solids/solid.h"

namespace ensonify::solids {

/// A simple body within a figure.
struct Part {
  Solid solid;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();  // in the figure's frame
};

/// The parts of a figure. They stand in each other where they join.
std::vector<Part> parts_of(const Figure& figure);

}  // namespace ensonify::solids
