#include "components/terrain/mesh_import.h"

#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <assimp/Importer.hpp>
#include <exception>
#include <filesystem>

#include "components/config/config_error.h"

namespace ensonify::source {
namespace {

constexpr double kMost_mb = 500.0;  // Assimp holds a file whole, several times over

[[noreturn]] void refuse(const std::string& path, const std::string& why) {
  throw ConfigError({ConfigProblem{{path, 0, 0}, "", why}});
}

}  // namespace

bool is_imported_mesh(const std::string& path) {
  constexpr std::array kEnds{".stl", ".off", ".gltf", ".glb"};
  return std::ranges::any_of(kEnds, [&](const char* end) { return path.ends_with(end); });
}

MeshFile import_mesh(const std::string& path) {
  std::error_code none;
  const double size_mb = 1e-6 * static_cast<double>(std::filesystem::file_size(path, none));
  if (!none && size_mb > kMost_mb)
    refuse(path, fmt::format("has {:.0f} MB; allowed: {:.0f} MB, or an OBJ or PLY file", size_mb, kMost_mb));
  Assimp::Importer importer;
  const aiScene* scene = nullptr;
  try {
    scene = importer.ReadFile(path, aiProcess_Triangulate | aiProcess_PreTransformVertices);
  } catch (const std::exception& error) {
    refuse(path, fmt::format("cannot be read: {}", error.what()));
  }
  if (scene == nullptr) refuse(path, fmt::format("cannot be read: {}", importer.GetErrorString()));
  MeshFile mesh;
  for (unsigned m = 0; m < scene->mNumMeshes; ++m) {
    const aiMesh& part = *scene->mMeshes[m];
    const auto first = static_cast<std::uint32_t>(mesh.vertex.size());
    for (unsigned v = 0; v < part.mNumVertices; ++v) {
      const frames::Vec3 place(part.mVertices[v].x, part.mVertices[v].y, part.mVertices[v].z);
      if (!place.allFinite())
        refuse(path, fmt::format("vertex {} of part {} is no place; allowed: finite numbers", v + 1, m + 1));
      mesh.vertex.push_back(place);
    }
    for (unsigned f = 0; f < part.mNumFaces; ++f) {
      const aiFace& face = part.mFaces[f];  // of points and lines: fewer corners
      if (face.mNumIndices == 3)
        mesh.triangle.push_back({first + face.mIndices[0], first + face.mIndices[1], first + face.mIndices[2]});
    }
  }
  return mesh;
}

}  // namespace ensonify::source
