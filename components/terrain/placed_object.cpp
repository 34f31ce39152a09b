#include "components/terrain/placed_object.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include "components/config/config_error.h"
#include "components/terrain/object_message.h"
#include "kernels/mesh/solids/rest.h"

namespace ensonify::source {
namespace {

constexpr double kSagitta = 0.01;    // of its size: to see where it stands, and what stands in its way
constexpr double kMostPosts = 64.0;  // of the ground, across an object

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
  message.absent = object.absent;
  return message;
}

Eigen::AlignedBox3d box_of(const progressive::TriangleMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3f& vertex : mesh.vertex_m) box.extend(mesh.origin_enu_m + vertex.cast<double>());
  return box;
}

/// Heights under an object and a little beyond, on posts of the ground's lattice; where the ground has a hole it is as
/// at the middle.
solids::GroundPatch patch_under(const TerrainSource& ground, const frames::Vec2& place_m, double reach_m,
                                double ground_m) {
  double spacing_m = ground.native_spacing_m();
  while (2.0 * reach_m > kMostPosts * spacing_m) spacing_m *= 2.0;
  const auto first = [&](double middle_m) {
    return static_cast<std::int64_t>(std::floor((middle_m - reach_m) / spacing_m)) - 1;
  };
  const int posts = static_cast<int>(std::ceil(2.0 * reach_m / spacing_m)) + 4;
  const PostBlock block{first(place_m.x()), first(place_m.y()), posts, posts, spacing_m};
  std::vector<float> height_m(block.size());
  std::vector<std::uint8_t> sediment(block.size());
  ground.sample(block, height_m, sediment);
  solids::GroundPatch patch{{block.east_m(0), block.north_m(0)}, spacing_m, {}};
  patch.height_m.resize(posts, posts);
  for (int n = 0; n < posts; ++n) {
    for (int e = 0; e < posts; ++e) {
      const auto height = static_cast<double>(
          height_m[static_cast<std::size_t>(n) * static_cast<std::size_t>(posts) + static_cast<std::size_t>(e)]);
      patch.height_m(n, e) = std::isfinite(height) ? height : ground_m;
    }
  }
  return patch;
}

/// Lays it down in balance.
void lay(const SceneObject& object, const solids::Solid& solid, const TerrainSource& ground, double ground_m,
         msg::Object& message) {
  const double radius_m = solids::radius_m(solid);
  const frames::Vec2 place = object.place.position_enu_m.head<2>();
  const solids::GroundPatch patch = patch_under(ground, place, radius_m, ground_m);
  const solids::Surface surface = solids::surface_of(solid, kSagitta * radius_m);
  const auto places = solids::places_of(surface, patch.spacing_m);
  const auto rest =
      solids::at_rest(places, solids::centre_of_mass(surface.mesh), object.place.enu_from_object(), place, patch);
  message.enu_from_object = frames::wxyz_of(frames::Quaternion(rest.turn));
  message.position_enu_m[2] = rest.height_m;
}

/// Part of a surface's volume below this height.
double buried_share(const solids::Surface& surface, const Eigen::AlignedBox3d& box_enu_m, double ground_m) {
  if (!std::isfinite(ground_m) || ground_m <= box_enu_m.min().z()) return 0.0;
  const double whole_m3 = solids::volume_below_m3(surface.mesh, box_enu_m.max().z());
  if (whole_m3 <= 0.0) return 0.0;
  return std::clamp(solids::volume_below_m3(surface.mesh, ground_m) / whole_m3, 0.0, 1.0);
}

}  // namespace

void refuse(const SceneObject& object, const std::string& why) {
  throw ConfigError({ConfigProblem{object.written, "objects." + object.name, why}});
}

namespace {

PlacedObject placed(const SceneObject& object, ObjectMeshes& meshes, const TerrainSource& ground) {
  const frames::Vec2 place = object.place.position_enu_m.head<2>();
  const Extent known = ground.extent();
  if (!known.contains(place))
    refuse(object, fmt::format("stands at ({:g}, {:g}) m, outside the terrain; allowed is east {:.0f} to {:.0f}, north "
                               "{:.0f} to {:.0f} m",
                               place.x(), place.y(), known.west_m, known.east_m, known.south_m, known.north_m));
  const double ground_m = ground.height_m(place);
  if ((object.place.rests || object.place.buried_share) && !std::isfinite(ground_m))
    refuse(object, fmt::format("stands at ({:g}, {:g}) m, where the terrain has a hole; allowed is a place with ground",
                               place.x(), place.y()));
  PlacedObject placed{message_of(object), {}, {}};
  solids::Solid solid = object.solid;
  if (object.file) {
    const ObjectMeshFile& file = meshes.of(object);
    placed.message.mesh = file.number;
    solid = solid_of(placed.message, &file.mesh);
  }
  if (object.laid) {
    const ObjectMeshFile& line = meshes.laid(object, ground);
    placed.message.mesh = line.number;
    placed.message.size_m = {1.0, 0.0, 0.0};
    placed.message.position_enu_m = {line.middle_enu_m.x(), line.middle_enu_m.y(), line.middle_enu_m.z()};
    placed.message.enu_from_object = frames::wxyz_of(frames::Quaternion::Identity());
    solid = line.mesh;
  }
  if (object.place.rests) lay(object, solid, ground, ground_m, placed.message);
  placed.surface = surface_of(placed.message, solid, kSagitta * radius_m(solid));
  if (object.place.buried_share) {
    const double below_m = solids::height_of_share_m(placed.surface.mesh, *object.place.buried_share);
    placed.surface.mesh.origin_enu_m.z() = placed.message.position_enu_m[2] = ground_m - below_m;
  }
  placed.box_enu_m = box_of(placed.surface.mesh);
  placed.message.buried = object.place.buried_share.value_or(buried_share(placed.surface, placed.box_enu_m, ground_m));
  const double top_m = placed.box_enu_m.max().z();
  if (std::isfinite(ground_m) && top_m < ground_m)
    refuse(object, fmt::format("lies below the seabed, which is at {:.2f} m there and it ends at {:.2f} m; allowed is "
                               "what shows something above it",
                               ground_m, top_m));
  return placed;
}

}  // namespace

PlacedObject placed_object(const SceneObject& object, ObjectMeshes& meshes, const TerrainSource& ground) {
  try {
    return placed(object, meshes, ground);
  } catch (const std::invalid_argument& error) {
    refuse(object, error.what());
  }
}

}  // namespace ensonify::source
