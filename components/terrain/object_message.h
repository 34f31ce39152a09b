#pragma once

#include "kernels/mesh/solids/solid.h"
#include "messages/terrain.h"

namespace ensonify {

/// Puts a shape into a message. The triangles of a mesh are in a message of their own, which `message.mesh` names.
void put_shape(const solids::Solid& solid, msg::Object& message);

/// The shape; of an object that names a mesh its triangles are `mesh`. Throws std::invalid_argument for a shape that
/// does not exist, and for a mesh that is missing.
solids::Solid solid_of(const msg::Object& message, const solids::Mesh* mesh = nullptr);

/// The triangles of a file, to and from a message.
msg::ObjectMesh object_mesh_message(std::int64_t number, const solids::Mesh& mesh);
solids::Mesh mesh_of(const msg::ObjectMesh& message);

/// A solid's surface where the object stands (solids::surface_of).
solids::Surface surface_of(const msg::Object& message, const solids::Solid& solid, double sagitta_m);

}  // namespace ensonify
