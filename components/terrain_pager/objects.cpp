#include "components/terrain_pager/objects.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "components/terrain/object_meshes.h"
#include "components/terrain/object_message.h"
#include "components/terrain/placed_object.h"
#include "components/terrain_pager/mission_track.h"

namespace ensonify::pager {
Objects::Objects(const TerrainPagerConfig& config, const source::TerrainSource& terrain) {
  if (config.objects.empty()) return;
  const MissionTrack track = track_of(config);
  source::ObjectMeshes files;
  for (const SceneObject& object : config.objects) {
    source::PlacedObject placed = source::placed_object(object, files, terrain);
    const Eigen::AlignedBox3d& box = placed.box_enu_m;
    if (box.max().z() > track.lowest_water_m)
      source::refuse(object, fmt::format("reaches {:.2f} m above chart datum, and the water falls to {:.2f} m; allowed "
                                         "is what stays below the water",
                                         box.max().z(), track.lowest_water_m));
    check_legs(track, "the object " + object.name, placed.surface.mesh);
    if (placed.message.mesh == static_cast<std::int64_t>(meshes_.size())) {
      const source::ObjectMeshFile& file = files.of(object);
      meshes_.push_back({object_mesh_message(file.number, file.mesh)});
      if (!file.said.empty()) said_.push_back(object.file->path + ": " + file.said);
    }
    objects_.push_back({std::move(placed.message), {box.min().head<2>(), box.max().head<2>()}});
  }
}

Objects::Decision Objects::update(const frames::Vec2& place_enu_m, const paging::Margins& margins) {
  Decision decision;
  for (One& one : objects_) {
    const double away_m = paging::distance_m(one.box, place_enu_m);
    if (!one.at_heads && away_m <= margins.feed_m) {
      one.at_heads = true;
      if (const std::int64_t mesh = one.message.mesh; mesh >= 0) {
        Shape& shape = meshes_[static_cast<std::size_t>(mesh)];
        if (!std::exchange(shape.at_heads, true)) decision.meshes.push_back(&shape.message);
      }
      decision.publish.push_back(&one.message);
    } else if (one.at_heads && away_m > margins.release_m) {
      one.at_heads = false;
      decision.release.push_back(one.message.number);
    }
  }
  return decision;
}

std::size_t Objects::max_bytes() const {
  constexpr std::size_t kEnvelope = 4096;  // of a message besides its arrays
  std::size_t most = kEnvelope;
  for (const Shape& shape : meshes_)
    most = std::max(most, kEnvelope + sizeof(float) * (shape.message.vertex_m.size() + shape.message.triangle.size()));
  return most;
}

}  // namespace ensonify::pager
