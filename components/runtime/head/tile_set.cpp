#include "components/runtime/head/tile_set.h"

#include <cmath>

namespace ensonify {
namespace {

constexpr double kFar_m = 3000.0;  // from Embree's origin: floats still tell 0.13 mm apart within 4 km (trace::Scene)

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
  tile.height_m.assign(height.begin(), height.end());
  tile.sediment.assign(sediment.begin(), sediment.end());

  grid_.spacing_m = tile.spacing_m;
  grid_.cells = tile.columns - 1;
  grid_.origin_enu_m = tile.origin_enu_m - grid_.side_m() * frames::Vec2(static_cast<double>(message.col),
                                                                         static_cast<double>(message.row));
  if ((tile.origin_enu_m - scene_.origin_enu_m()).lpNorm<Eigen::Infinity>() > kFar_m) {
    scene_.recentre(tile.origin_enu_m);
  }
  scene_.insert(key_of(message.col, message.row), tile);
}

void TileSet::release(const msg::TileRelease& release) { scene_.remove(key_of(release.col, release.row)); }

bool TileSet::covers(const frames::Vec2& place_enu_m) const {
  return !scene_.empty() && scene_.contains(grid_.key_at(place_enu_m));
}

}  // namespace ensonify
