#pragma once

#include <string>

#include "components/terrain/object_meshes.h"
#include "components/terrain/terrain_source.h"
#include "kernels/mesh/solids/solid.h"
#include "messages/terrain.h"
#include "scenarios/world/objects.h"

namespace ensonify::source {

/// A scenario's object where it stands.
struct PlacedObject {
  msg::Object message;
  solids::Surface surface;  // coarse: a hundredth of its size
  Eigen::AlignedBox3d box_enu_m;
};

/// On the seabed an object lies in balance on the heights of `ground`, or is so deep that the wanted share of its
/// volume lies below the height at its middle. A shape from a file comes from `meshes`. Throws ConfigError, with its
/// place in the scenario, for one that stands beside `ground` or over a hole in it, that is wholly below it, or that
/// takes too many triangles.
PlacedObject placed_object(const SceneObject& object, ObjectMeshes& meshes, const TerrainSource& ground);

/// Throws ConfigError of that object.
[[noreturn]] void refuse(const SceneObject& object, const std::string& why);

}  // namespace ensonify::source
