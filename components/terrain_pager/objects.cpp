#include "components/terrain_pager/objects.h"

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <utility>

#include "components/terrain/object_message.h"
#include "components/terrain_pager/mission_track.h"

namespace ensonify::pager {
namespace {

constexpr double kSagitta = 0.01;  // of its size: to see where it stands, and what stands in its way

[[noreturn]] void refuse(const SceneObject& object, const std::string& why) {
  throw ConfigError({ConfigProblem{object.written, "objects." + object.name, why}});
}

Eigen::AlignedBox3d box_of(const progressive::TriangleMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3f& vertex : mesh.vertex_m) box.extend(mesh.origin_enu_m + vertex.cast<double>());
  return box;
}

msg::Object message_of(const SceneObject& object) {
  msg::Object message;
  message.number = static_cast<std::int64_t>(object.instance) - 1;
  message.name = object.name;
  message.instance = object.instance;
  message.class_name = object.class_name;
  message.class_id = object.class_id;
  put_shape(object.solid, message);
  message.position_enu_m = {object.place.position_enu_m.x(), object.place.position_enu_m.y(),
                            object.place.position_enu_m.z()};
  message.enu_from_object = frames::wxyz_of(frames::Quaternion(object.place.enu_from_object()));
  message.smooth = object.smooth;
  message.sediment = object.sediment;
  return message;
}

/// Puts it on the ground: so deep that the wanted share of its volume lies below the ground's height at its middle.
void rest(const SceneObject& object, double ground_m, solids::Surface& surface, msg::Object& message) {
  const double below_m = solids::height_of_share_m(surface.mesh, *object.place.buried_share);
  surface.mesh.origin_enu_m.z() = message.position_enu_m[2] = ground_m - below_m;
}

}  // namespace

Objects::Objects(const TerrainPagerConfig& config, const source::TerrainSource& terrain) {
  if (config.objects.empty()) return;
  const source::Extent known = terrain.extent();
  const MissionTrack track = track_of(config);
  for (const SceneObject& object : config.objects) {
    const frames::Vec3& wanted = object.place.position_enu_m;
    msg::Object message = message_of(object);
    solids::Surface surface = surface_of(message, kSagitta * radius_m(object.solid));
    if (!known.contains(wanted.head<2>()))
      refuse(object,
             fmt::format("stands at ({:g}, {:g}) m, outside the terrain; allowed is east {:.0f} to {:.0f}, north "
                         "{:.0f} to {:.0f} m",
                         wanted.x(), wanted.y(), known.west_m, known.east_m, known.south_m, known.north_m));
    const double ground_m = terrain.height_m(wanted.head<2>());
    if (object.place.buried_share && !std::isfinite(ground_m))
      refuse(object,
             fmt::format("stands at ({:g}, {:g}) m, where the terrain has a hole; allowed is a place with ground",
                         wanted.x(), wanted.y()));
    if (object.place.buried_share) rest(object, ground_m, surface, message);
    const Eigen::AlignedBox3d box = box_of(surface.mesh);
    if (box.max().z() > track.lowest_water_m)
      refuse(object, fmt::format("reaches {:.2f} m above chart datum, and the water falls to {:.2f} m; allowed is what "
                                 "stays below the water",
                                 box.max().z(), track.lowest_water_m));
    if (std::isfinite(ground_m) && box.max().z() < ground_m)
      refuse(object,
             fmt::format("lies below the seabed, which is at {:.2f} m there and it ends at {:.2f} m; allowed is "
                         "what shows something above it",
                         ground_m, box.max().z()));
    check_legs(track, "the object " + object.name, surface.mesh);
    objects_.push_back({std::move(message), {box.min().head<2>(), box.max().head<2>()}});
  }
}

Objects::Decision Objects::update(const frames::Vec2& place_enu_m, const paging::Margins& margins) {
  Decision decision;
  for (One& one : objects_) {
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

}  // namespace ensonify::pager
