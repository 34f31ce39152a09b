#include "components/terrain_pager/objects.h"

#include <fmt/format.h>
#include <tbb/parallel_for_each.h>

#include <algorithm>
#include <utility>

#include "components/terrain/object_message.h"
#include "components/terrain/placed_object.h"

namespace ensonify::pager {

Objects::Objects(const TerrainPagerConfig& config, const source::TerrainSource& terrain) : terrain_(terrain) {
  if (config.objects.empty()) return;
  track_ = track_of(config);
  for (const SceneObject& object : config.objects) {
    solids::Solid solid = object.solid;
    if (object.file) {
      read_mesh(files_.of(object), object.file->path);
      std::get<solids::Mesh>(solid).triangles = files_.of(object).mesh.triangles;
    }
    if (object.laid) {
      read_mesh(files_.laid(object, terrain), object.name);
      solid = files_.laid(object, terrain).mesh;
    }
    const double reach_m = solids::radius_m(solid);
    const frames::Vec2 place = object.place.position_enu_m.head<2>(), reach = frames::Vec2::Constant(reach_m);
    objects_.push_back({object, std::nullopt, {place - reach, place + reach}});
  }
  if (objects_.size() > kPlacedAtOnce) return;
  std::vector<One*> all;
  for (One& one : objects_) all.push_back(&one);
  place_all(all);
}

/// Its shape as a message, where it is a new one.
void Objects::read_mesh(const source::ObjectMeshFile& file, const std::string& name) {
  if (file.number < static_cast<std::int64_t>(meshes_.size())) return;
  meshes_.push_back({object_mesh_message(file.number, file.mesh)});
  if (!file.said.empty()) said_.push_back(name + ": " + file.said);
}

/// All files have been read, so that several may be placed at a time.
void Objects::place(One& one) {
  source::PlacedObject placed = source::placed_object(one.wanted, files_, terrain_);
  const Eigen::AlignedBox3d& box = placed.box_enu_m;
  if (box.max().z() > track_->lowest_water_m)
    source::refuse(one.wanted, fmt::format("reaches {:.2f} m above chart datum, and the water falls to {:.2f} m; "
                                           "allowed is what stays below the water",
                                           box.max().z(), track_->lowest_water_m));
  check_legs(*track_, "the object " + one.wanted.name, placed.surface.mesh);
  one.message = std::move(placed.message);
  one.box = {box.min().head<2>(), box.max().head<2>()};
}

void Objects::place_all(const std::vector<One*>& wanted) {
  tbb::parallel_for_each(wanted, [&](One* one) { place(*one); });
}

Objects::Decision Objects::update(const frames::Vec2& place_enu_m, const paging::Margins& margins) {
  const auto away_m = [&](const One& one) { return paging::distance_m(one.box, place_enu_m); };
  std::vector<One*> unplaced;
  for (One& one : objects_) {
    if (!one.message && away_m(one) <= margins.feed_m) unplaced.push_back(&one);
  }
  place_all(unplaced);

  Decision decision;
  for (One& one : objects_) {
    if (!one.at_heads && one.message && away_m(one) <= margins.feed_m) {
      one.at_heads = true;
      if (const std::int64_t mesh = one.message->mesh; mesh >= 0) {
        Shape& shape = meshes_[static_cast<std::size_t>(mesh)];
        if (!std::exchange(shape.at_heads, true)) decision.meshes.push_back(&shape.message);
      }
      decision.publish.push_back(&*one.message);
    } else if (one.at_heads && away_m(one) > margins.release_m) {
      one.at_heads = false;
      decision.release.push_back(one.message->number);
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
