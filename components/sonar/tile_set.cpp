#include "components/sonar/tile_set.h"

#include <algorithm>
#include <utility>

#include "components/terrain/mesh_message.h"
#include "components/terrain/object_message.h"
#include "kernels/acoustics/echo/smooth_facet.h"
#include "kernels/acoustics/trace/batch.h"

namespace ensonify {
namespace {

constexpr double kDiffuseSagitta = 0.001;  // of an object's size: outlines of labels

terrain::TileKey key_of(std::int64_t col, std::int64_t row) {
  return {static_cast<std::int32_t>(col), static_cast<std::int32_t>(row)};
}

}  // namespace

void TileSet::insert(const msg::Tile& message) {
  terrain::Tile tile;
  tile.origin_enu_m = {message.origin_east_m, message.origin_north_m};
  tile.spacing_m = message.spacing_m;
  tile.columns = static_cast<std::int32_t>(message.height_m.cols());
  tile.rows = static_cast<std::int32_t>(message.height_m.rows());
  const auto height = message.height_m.flat();
  const auto sediment = message.sediment.flat();
  trace::make_room(tile.height_m, height.size());
  tile.height_m.assign(height.begin(), height.end());
  // Where all posts are of one class rays need not look theirs up, nor is there memory for it.
  if (!sediment.empty() && std::equal(sediment.begin() + 1, sediment.end(), sediment.begin())) {
    tile.everywhere = sediment.front();
  } else {
    tile.sediment.assign(sediment.begin(), sediment.end());
  }

  grid_.spacing_m = tile.spacing_m;
  grid_.cells = tile.columns - 1;
  grid_.origin_enu_m = tile.origin_enu_m - grid_.side_m() * frames::Vec2(static_cast<double>(message.col),
                                                                         static_cast<double>(message.row));
  if (scene_.empty()) scene_.centre_near(tile.origin_enu_m);  // where the head will be: nothing is built twice
  scene_.insert(key_of(message.col, message.row), std::move(tile));
  scene_.set_facet_mean_square_slope(message.facet_mean_square_slope.flat());
}

void TileSet::release(const msg::TileRelease& release) { scene_.remove(key_of(release.col, release.row)); }

void TileSet::insert(const msg::Mesh& message) {
  scene_.insert(message.number,
                trace::IrregularMesh{hierarchy_of(message), static_cast<std::uint8_t>(message.sediment)});
}

void TileSet::release(const msg::MeshRelease& release) { scene_.remove(release.number); }

void TileSet::insert(const msg::ObjectMesh& mesh) { object_mesh_.insert_or_assign(mesh.number, mesh_of(mesh)); }

void TileSet::insert(const msg::Object& object) {
  const auto mesh = object_mesh_.find(object.mesh);
  const solids::Solid solid = solid_of(object, mesh == object_mesh_.end() ? nullptr : &mesh->second);
  const double sagitta_m =
      object.smooth ? echo::kSagittaInWaves * shortest_wave_m_ : kDiffuseSagitta * solids::radius_m(solid);
  trace::Body body;
  body.surface = surface_of(object, solid, sagitta_m);
  body.two_sided = !solids::is_closed(solid);
  body.smooth = object.smooth;
  body.sediment = static_cast<std::uint8_t>(object.sediment);
  body.instance = static_cast<std::uint32_t>(object.instance);
  body.label_class = static_cast<std::uint32_t>(object.class_id);
  body.name = object.name;
  body.class_name = object.class_name;
  body.buried = object.buried;
  body.absent = object.absent;
  body.enu_from_body = frames::quaternion_of(object.enu_from_object);
  scene_.insert_body(static_cast<std::uint32_t>(object.number), std::move(body));
}

void TileSet::release(const msg::ObjectRelease& release) {
  scene_.remove_body(static_cast<std::uint32_t>(release.number));
}

bool TileSet::covers(const frames::Vec2& place_enu_m) const {
  return !scene_.empty() && scene_.contains(grid_.key_at(place_enu_m));
}

}  // namespace ensonify
