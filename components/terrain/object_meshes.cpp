#include "components/terrain/object_meshes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <set>
#include <unordered_map>
#include <utility>

#include "components/config/config_error.h"
#include "components/terrain/mesh_file.h"

namespace ensonify::source {
namespace {

using frames::Vec3;
using progressive::TriangleMesh;

constexpr std::size_t kMostTriangles = 500'000;
constexpr double kLargest_m = 100.0;  // what is larger in metres is taken for millimetres

/// Millimetres where metres would be beyond belief.
double guessed_unit_m(const MeshFile& file) {
  Eigen::AlignedBox3d box;
  for (const Vec3& place : file.vertex) box.extend(place);
  return box.sizes().maxCoeff() > kLargest_m ? 1e-3 : 1.0;
}

/// Vertices at one place become one: files of triangles repeat them.
TriangleMesh joined(const MeshFile& file, double unit_m, bool y_is_up) {
  const auto upright = [&](const Vec3& place) {
    return Vec3(unit_m * (y_is_up ? Vec3(place.x(), -place.z(), place.y()) : place));
  };
  Eigen::AlignedBox3d box;
  for (const auto& corners : file.triangle) {
    for (const std::uint32_t corner : corners) box.extend(upright(file.vertex[corner]));
  }
  TriangleMesh mesh;
  std::map<std::array<float, 3>, std::uint32_t> known;
  const auto vertex = [&](std::uint32_t corner) {
    const Eigen::Vector3f place = (upright(file.vertex[corner]) - box.center()).cast<float>();
    const auto [at, is_new] =
        known.try_emplace({place.x(), place.y(), place.z()}, static_cast<std::uint32_t>(mesh.vertex_m.size()));
    if (is_new) mesh.vertex_m.push_back(place);
    return at->second;
  };
  for (const auto& [a, b, c] : file.triangle) {
    const progressive::Triangle triangle{vertex(a), vertex(b), vertex(c)};
    if (triangle[0] != triangle[1] && triangle[1] != triangle[2] && triangle[2] != triangle[0])
      mesh.triangle.push_back(triangle);
  }
  return mesh;
}

/// Every edge is there once in each direction.
bool is_closed(const TriangleMesh& mesh) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const auto& t : mesh.triangle) {
    for (std::size_t c = 0; c < 3; ++c) {
      if (!edges.emplace(t[c], t[(c + 1) % 3]).second) return false;
    }
  }
  return std::ranges::all_of(edges, [&](const auto& edge) { return edges.contains({edge.second, edge.first}); });
}

}  // namespace

const ObjectMeshFile& ObjectMeshes::of(const SceneObject& object) {
  const ObjectFile& wanted = object.file.value();
  const Key key{wanted.path, wanted.unit_m.value_or(0.0), wanted.y_is_up};
  if (const auto at = meshes_.find(key); at != meshes_.end()) return at->second;

  const auto refuse = [&](const std::string& why) {
    throw ConfigError({ConfigProblem{object.written, "objects." + object.name + ".mesh", why}});
  };
  const MeshFile file = read_mesh_file(wanted.path);
  if (file.triangle.size() > kMostTriangles)
    refuse(fmt::format("{} has {} triangles; allowed: {}, fewer by any mesh editor, or a mesh of the seabed",
                       wanted.path, file.triangle.size(), kMostTriangles));
  const double unit_m = wanted.unit_m.value_or(guessed_unit_m(file));
  TriangleMesh triangles = joined(file, unit_m, wanted.y_is_up);
  if (triangles.triangle.empty())
    refuse(wanted.path + " has no triangles of any area; allowed: a surface of triangles");

  ObjectMeshFile made{static_cast<std::int64_t>(meshes_.size()), {}, ""};
  const auto say = [&](const std::string& what) { made.said += (made.said.empty() ? "" : "; ") + what; };
  if (!wanted.unit_m && unit_m != 1.0)
    say(fmt::format("in millimetres, as it would be larger than {:g} m; unit_m says otherwise", kLargest_m));
  made.mesh.closed = is_closed(triangles);
  if (!made.mesh.closed) say("not closed: both sides of its surface scatter");
  if (made.mesh.closed && solids::volume_below_m3(triangles, 1e6) < 0.0) {
    for (auto& corners : triangles.triangle) std::swap(corners[1], corners[2]);
    say("inside out: turned");
  }
  made.mesh.triangles = std::make_shared<const TriangleMesh>(std::move(triangles));
  return meshes_.emplace(key, std::move(made)).first->second;
}

const ObjectMeshFile& ObjectMeshes::laid(const SceneObject& object, const TerrainSource& ground) {
  const LaidSection& section = object.laid.value();
  const Key key{"laid " + object.name, 0.0, false};
  if (const auto at = meshes_.find(key); at != meshes_.end()) return at->second;
  auto line = lines_.find(section.route);
  if (line == lines_.end()) line = lines_.emplace(section.route, LaidLine(object, ground)).first;

  progressive::TriangleMesh mesh = line->second.surface(object).mesh;
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3f& vertex : mesh.vertex_m) box.extend(vertex);
  const Eigen::Vector3f middle = box.center();
  for (Eigen::Vector3f& vertex : mesh.vertex_m) vertex -= middle;
  ObjectMeshFile made{static_cast<std::int64_t>(meshes_.size()), {nullptr, true}, "", {}};
  made.middle_enu_m = mesh.origin_enu_m + middle.cast<double>();
  mesh.origin_enu_m.setZero();
  made.mesh.triangles = std::make_shared<const TriangleMesh>(std::move(mesh));
  return meshes_.emplace(key, std::move(made)).first->second;
}

}  // namespace ensonify::source
