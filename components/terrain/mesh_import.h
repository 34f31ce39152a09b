#pragma once

#include <string>

#include "components/terrain/mesh_file.h"

namespace ensonify::source {

/// Whether Assimp reads it for us, by its name's end: .stl, .off, .gltf, .glb.
bool is_imported_mesh(const std::string& path);

/// All triangles of such a file, with the transforms of its nodes, in the file's units (single precision). Throws
/// ConfigError with the file, what is wrong with it and what is allowed.
MeshFile import_mesh(const std::string& path);

}  // namespace ensonify::source
