#include "components/terrain_pager/meshes.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "components/terrain/mesh_message.h"
#include "components/terrain/prepared_mesh.h"
#include "components/terrain_pager/mission_track.h"
#include "kernels/mesh/progressive/hierarchy.h"

namespace ensonify::pager {
namespace {

constexpr std::size_t kMostKept = 100'000;  // vertices; some 10 MB beside the message
constexpr std::size_t kEnvelope = 4096;     // of a message besides its arrays

std::size_t bytes_of(const msg::Mesh& mesh) {
  return kEnvelope + sizeof(float) * (mesh.vertex_m.size() + mesh.triangle.size() + mesh.split.size() +
                                      mesh.split_deviation_m.size() + mesh.split_box_m.size() + mesh.born.size() +
                                      mesh.coarsest.size());
}

paging::Box box_of(const progressive::TriangleMesh& mesh) {
  Eigen::AlignedBox2d box;
  for (const auto& corners : mesh.triangle) {
    for (const std::uint32_t vertex : corners)
      box.extend((mesh.origin_enu_m + mesh.vertex_m[vertex].cast<double>()).head<2>());
  }
  return {box.min(), box.max()};
}

void refuse(const TerrainPagerConfig& config, const std::string& name, const std::string& why) {
  throw ConfigError({ConfigProblem{{config.scenario_file, 0, 0}, "seabed.meshes." + name, why}});
}

}  // namespace

Meshes::Meshes(const TerrainPagerConfig& config, const source::TerrainSource& terrain, Made& made) {
  const source::Extent known = terrain.extent();
  const MissionTrack track = track_of(config);
  std::size_t bytes = 0;
  for (const SeabedMesh& mesh : config.terrain.seabed.meshes) {
    std::shared_ptr<const source::PlacedMesh>& kept = made[mesh.name];
    if (!kept)
      kept =
          std::make_shared<source::PlacedMesh>(source::placed_mesh(mesh, config.terrain.seabed.layered.seed, terrain));
    const source::PlacedMesh& placed = *kept;
    if (placed.worth_preparing) unprepared_.push_back(mesh.name);
    if (placed.hierarchy.mesh.triangle.empty()) refuse(config, mesh.name, "has no triangles");
    const paging::Box box = box_of(placed.hierarchy.mesh);
    if (box.low.x() > known.east_m || box.low.y() > known.north_m || box.high.x() < known.west_m ||
        box.high.y() < known.south_m)
      refuse(
          config, mesh.name,
          fmt::format("lies at east {:.0f} to {:.0f}, north {:.0f} to {:.0f} m, outside the terrain; allowed is east "
                      "{:.0f} to {:.0f}, north {:.0f} to {:.0f} m (position_m moves it)",
                      box.low.x(), box.high.x(), box.low.y(), box.high.y(), known.west_m, known.east_m, known.south_m,
                      known.north_m));
    check_legs(track, "the mesh " + mesh.name, placed.hierarchy.mesh);
    One one{mesh_message(placed.hierarchy), box};
    one.message.number = static_cast<std::int64_t>(meshes_.size());
    one.message.name = mesh.name;
    one.message.sediment = mesh.sediment;
    bytes += bytes_of(one.message);
    if (1e-6 * static_cast<double>(bytes) > config.head_budget_mb)
      refuse(config, mesh.name,
             fmt::format("makes {:.0f} MB of meshes in every head; at most {:g} MB are allowed: use one of fewer "
                         "triangles, or raise the pager's head_budget_mb",
                         1e-6 * static_cast<double>(bytes), config.head_budget_mb));
    meshes_.push_back(std::move(one));
    if (placed.hierarchy.mesh.vertex_m.size() > kMostKept) kept.reset();
  }
}

Meshes::Decision Meshes::update(const frames::Vec2& place_enu_m, const paging::Margins& margins) {
  Decision decision;
  for (One& one : meshes_) {
    const double away_m = paging::distance_m(one.box, place_enu_m);
    if (!one.at_heads && away_m <= margins.feed_m) {
      one.at_heads = true;
      decision.publish.push_back(&one.message);
    } else if (one.at_heads && away_m > margins.release_m) {
      one.at_heads = false;
      decision.release.push_back(one.message.number);
    }
  }
  return decision;
}

std::size_t Meshes::max_bytes() const {
  std::size_t most = kEnvelope;
  for (const One& one : meshes_) most = std::max(most, bytes_of(one.message));
  return most;
}

}  // namespace ensonify::pager
