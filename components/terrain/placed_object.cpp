#include "components/terrain/placed_object.h"

#include <fmt/format.h>

#include <cmath>

#include "components/config/config_error.h"
#include "components/terrain/object_message.h"

namespace ensonify::source {
namespace {

constexpr double kSagitta = 0.01;  // of its size: to see where it stands, and what stands in its way

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

Eigen::AlignedBox3d box_of(const progressive::TriangleMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3f& vertex : mesh.vertex_m) box.extend(mesh.origin_enu_m + vertex.cast<double>());
  return box;
}

}  // namespace

void refuse(const SceneObject& object, const std::string& why) {
  throw ConfigError({ConfigProblem{object.written, "objects." + object.name, why}});
}

PlacedObject placed_object(const SceneObject& object, const TerrainSource& ground) {
  const frames::Vec2 place = object.place.position_enu_m.head<2>();
  const Extent known = ground.extent();
  if (!known.contains(place))
    refuse(object, fmt::format("stands at ({:g}, {:g}) m, outside the terrain; allowed is east {:.0f} to {:.0f}, north "
                               "{:.0f} to {:.0f} m",
                               place.x(), place.y(), known.west_m, known.east_m, known.south_m, known.north_m));
  const double ground_m = ground.height_m(place);
  PlacedObject placed{message_of(object), {}, {}};
  placed.surface = surface_of(placed.message, kSagitta * radius_m(object.solid));
  if (object.place.buried_share) {
    if (!std::isfinite(ground_m))
      refuse(object,
             fmt::format("stands at ({:g}, {:g}) m, where the terrain has a hole; allowed is a place with ground",
                         place.x(), place.y()));
    const double below_m = solids::height_of_share_m(placed.surface.mesh, *object.place.buried_share);
    placed.surface.mesh.origin_enu_m.z() = placed.message.position_enu_m[2] = ground_m - below_m;
  }
  placed.box_enu_m = box_of(placed.surface.mesh);
  const double top_m = placed.box_enu_m.max().z();
  if (std::isfinite(ground_m) && top_m < ground_m)
    refuse(object, fmt::format("lies below the seabed, which is at {:.2f} m there and it ends at {:.2f} m; allowed is "
                               "what shows something above it",
                               ground_m, top_m));
  return placed;
}

}  // namespace ensonify::source
