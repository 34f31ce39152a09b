#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "kernels/base/frames/attitude.h"

namespace ensonify::source {

/// A surface of triangles as a file has it, in the file's units.
struct MeshFile {
  std::vector<frames::Vec3> vertex;
  std::vector<std::array<std::uint32_t, 3>> triangle;
};

/// Whether the name ends as those of meshes of terrain do: .obj, .ply.
bool is_mesh_file(const std::string& path);

/// STL, OFF and glTF by Assimp (mesh_import.h); in double precision, as maps need it, Wavefront OBJ (its v and f lines;
/// colours, normals, textures and groups are ignored) and PLY (ASCII or binary little endian; a vertex has x, y, z, a
/// face a list of them). Faces of more than three corners become fans; those that have a corner twice are left out. A
/// mesh without area is refused. Throws ConfigError with file, line and what is allowed.
MeshFile read_mesh_file(const std::string& path);

}  // namespace ensonify::source
