#include "components/runtime/terrain/prepared_mesh.h"

#include <filesystem>
#include <optional>
#include <utility>

#include "components/runtime/config/config_error.h"
#include "components/runtime/terrain/mesh_file.h"
#include "components/runtime/tiles/lattice_png.h"
#include "components/runtime/tiles/sha256.h"
#include "kernels/progressive/collapse.h"

namespace ensonify::source {
namespace {

/// In metres, about a whole number of them in its middle.
progressive::TriangleMesh metres_of(const MeshFile& file, double unit_m) {
  Eigen::AlignedBox3d box;
  for (const frames::Vec3& place : file.vertex) box.extend(place * unit_m);
  progressive::TriangleMesh mesh;
  if (!box.isEmpty()) mesh.origin_enu_m = box.center().array().round() + 0.0;  // no -0
  for (const frames::Vec3& place : file.vertex)
    mesh.vertex_m.emplace_back((place * unit_m - mesh.origin_enu_m).cast<float>());
  mesh.triangle = file.triangle;
  return mesh;
}

/// What was made of this very file before; nothing if it was not, or is damaged.
std::optional<LodFile> made_before(const std::string& path, const std::string& made_from, double unit_m) {
  if (!std::filesystem::exists(path)) return std::nullopt;
  try {
    LodFile lod = read_lod_file(path);
    if (lod.source_sha256 == made_from && lod.unit_m == unit_m) return lod;
  } catch (const tiles::TileError&) {  // made again
  }
  return std::nullopt;
}

progressive::Hierarchy hierarchy_of(progressive::TriangleMesh mesh) {
  const auto collapses = progressive::collapses_of(mesh);
  return progressive::hierarchy_of(std::move(mesh), collapses);
}

}  // namespace

std::string lod_path_of(const std::string& mesh_path) { return mesh_path + ".lod"; }

PreparedMesh prepared_mesh(const std::string& mesh_path, double unit_m, const std::string& lod_path) {
  const std::string made_from = tiles::sha256_of_file(mesh_path);
  if (auto lod = made_before(lod_path, made_from, unit_m)) return {std::move(*lod), true};
  progressive::TriangleMesh mesh = metres_of(read_mesh_file(mesh_path), unit_m);
  if (const std::string fault = fault_of(mesh); !fault.empty())
    throw ConfigError({ConfigProblem{{mesh_path, 0, 0}, "", fault}});
  return {LodFile{hierarchy_of(std::move(mesh)), made_from, unit_m}, false};
}

PlacedMesh placed_mesh(const SeabedMesh& mesh, std::uint64_t seed) {
  if (mesh.wall) return {hierarchy_of(progressive::mesh_of(*mesh.wall, {seed, "seabed/meshes/" + mesh.name}))};
  PreparedMesh prepared = prepared_mesh(mesh.file, mesh.unit_m, lod_path_of(mesh.file));
  return {progressive::placed(std::move(prepared.lod.hierarchy), mesh.position_enu_m, mesh.heading_rad),
          prepared.cached};
}

}  // namespace ensonify::source
