#pragma once

#include "kernels/mesh/progressive/hierarchy.h"
#include "messages/terrain.h"

namespace ensonify {

/// A mesh as it is published. Number, name and sediment are the caller's to add.
msg::Mesh mesh_message(const progressive::Hierarchy& hierarchy);

/// The reverse. Throws std::invalid_argument when the sizes of its arrays do not go together; what they hold is checked
/// by progressive::fault_of.
progressive::Hierarchy hierarchy_of(const msg::Mesh& message);

}  // namespace ensonify
