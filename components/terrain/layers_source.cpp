#include "components/terrain/layers_source.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include "components/config/config_error.h"
#include "components/terrain/raster_source.h"
#include "components/terrain/tile_set_source.h"

namespace ensonify::source {
namespace {

using relief::Window;

constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

Extent extent_of(const LayeredSeabed& seabed) {
  const Vec2 low = seabed.centre_enu_m - 0.5 * seabed.size_m, high = seabed.centre_enu_m + 0.5 * seabed.size_m;
  return {low.x(), low.y(), high.x(), high.y()};
}

/// The posts of a block that lie on the seabed. None are made of the others.
PostBlock within(const Extent& extent, const PostBlock& posts) {
  const auto narrow = [](int& first, int& count, const auto& lies_within) {
    while (count > 0 && !lies_within(first + count - 1)) --count;
    while (count > 0 && !lies_within(first)) ++first, --count;
  };
  int west = 0, south = 0;
  PostBlock inside = posts;
  narrow(west, inside.columns,
         [&](int i) { return posts.east_m(i) >= extent.west_m && posts.east_m(i) <= extent.east_m; });
  narrow(south, inside.rows,
         [&](int j) { return posts.north_m(j) >= extent.south_m && posts.north_m(j) <= extent.north_m; });
  inside.first_east += west;
  inside.first_north += south;
  return inside;
}

/// The nodes of a level from the last at or before `low` to the first at or after `high`.
Window window_around(int level, double spacing_m, const Vec2& low, const Vec2& high) {
  const double step_m = relief::node_spacing_m(spacing_m, level);
  const auto first = [&](double m) { return static_cast<std::int64_t>(std::floor(m / step_m)); };
  const auto count = [&](double from, double to) {
    return static_cast<int>(static_cast<std::int64_t>(std::ceil(to / step_m)) - first(from)) + 2;
  };
  return {level, first(low.x()), first(low.y()), count(low.x(), high.x()), count(low.y(), high.y())};
}

constexpr std::size_t kMostCells = 64'000'000;  // 256 MB

std::unique_ptr<TerrainSource> opened(const layers::Guide& guide, const frames::Geodetic& origin) {
  if (guide.tiles_folder.empty()) {
    RasterOptions options;
    options.path = guide.raster;
    options.values_are_depths = guide.values_are_depths;
    return std::make_unique<RasterSource>(options, origin);
  }
  auto tiles = std::make_unique<TileSetSource>(guide.tiles_folder);
  if (const std::string fault = fault_of_origin(tiles->origin(), origin); !fault.empty())
    throw std::invalid_argument("the guide's tiles: their origin " + fault + "; allowed: the same");
  return tiles;
}

relief::Raster read(const layers::Guide& guide, const LayeredSeabed& seabed, const frames::Geodetic& origin) {
  const auto file = opened(guide, origin);
  const frames::Vec2 corner = seabed.centre_enu_m - 0.5 * seabed.size_m;
  PostBlock block;
  block.spacing_m = guide.cell_m;
  block.first_east = static_cast<std::int64_t>(std::floor(corner.x() / guide.cell_m));
  block.first_north = static_cast<std::int64_t>(std::floor(corner.y() / guide.cell_m));
  block.columns = static_cast<int>(std::ceil(seabed.size_m.x() / guide.cell_m)) + 2;
  block.rows = static_cast<int>(std::ceil(seabed.size_m.y() / guide.cell_m)) + 2;
  if (block.size() > kMostCells)
    throw std::invalid_argument("the guide would have " + std::to_string(block.size()) +
                                " cells, allowed: " + std::to_string(kMostCells) + "; widen cell_m");
  relief::Raster raster{block.columns, block.rows, guide.cell_m, {block.east_m(0), block.north_m(0)}, {}};
  raster.value.resize(block.size());
  std::vector<std::uint8_t> sediment(block.size());
  file->sample(block, raster.value, sediment);
  const auto holes = std::count_if(raster.value.begin(), raster.value.end(), [](float z) { return std::isnan(z); });
  if (holes > 0)
    throw std::invalid_argument("the guide has no height at " + std::to_string(holes) + " of " +
                                std::to_string(block.size()) + " cells of the seabed; fill it, or narrow size_m");
  return raster;
}

/// Reads guides from their rasters and tile sets: heights on cells of the size asked for, over the seabed's rectangle
/// and a little more. `origin` is the world's. What it returns throws std::invalid_argument for tiles of another
/// origin, holes, or more than 64 million cells, and ConfigError for a file that cannot be read; it is good for as long
/// as `seabed` is.
GuideReader guide_files(const LayeredSeabed& seabed, const frames::Geodetic& origin) {
  return [&seabed, origin](const layers::Guide& guide) { return read(guide, seabed, origin); };
}

}  // namespace

LayersSource::LayersSource(const Seabed& seabed, const frames::Geodetic& origin)
    : description_(seabed),
      fields_(fields_of(seabed.layered, seabed.post_spacing_m, guide_files(seabed.layered, origin))),
      extent_(extent_of(seabed.layered)),
      origin_(origin) {
  probe();
  if (lowest_m_ >= 0.0) {
    throw ConfigError(
        {ConfigProblem{{seabed.layered.file, 0, 0},
                       "seabed.layers",
                       "make a seabed that is nowhere under water; a layer such as plane gives its depth"}});
  }
}

void LayersSource::probe() {
  constexpr double kProbes = 256.0;  // per side: enough for the range of depths that a chart gives
  const double side_m = std::max(extent_.east_m - extent_.west_m, extent_.north_m - extent_.south_m);
  const int level =
      std::max(0, static_cast<int>(std::ceil(std::log2(side_m / (kProbes * description_.post_spacing_m)))));
  const terrain::Tile tile = tile_of(window_around(
      level, description_.post_spacing_m, {extent_.west_m, extent_.south_m}, {extent_.east_m, extent_.north_m}));
  lowest_m_ = std::numeric_limits<double>::max();
  highest_m_ = std::numeric_limits<double>::lowest();
  for (std::int32_t row = 0; row < tile.rows; ++row) {
    for (std::int32_t column = 0; column < tile.columns; ++column) {
      const auto place = tile.position_enu_m(column, row);
      if (!extent_.contains(place.head<2>())) continue;
      lowest_m_ = std::min(lowest_m_, place.z());
      highest_m_ = std::max(highest_m_, place.z());
    }
  }
}

terrain::Tile LayersSource::tile_of(const Window& window) const {
  const double step_m = relief::node_spacing_m(description_.post_spacing_m, window.level);
  terrain::Tile tile{{static_cast<double>(window.east) * step_m, static_cast<double>(window.north) * step_m},
                     step_m,
                     window.columns,
                     window.rows,
                     std::vector<float>(window.size()),
                     std::vector<std::uint8_t>(window.size())};
  fields_.seabed.fill(window, tile.height_m, tile.sediment);
  return tile;
}

void LayersSource::sample(const PostBlock& posts, std::span<float> height_m, std::span<std::uint8_t> sediment) const {
  const PostBlock inside = within(extent_, posts);
  if (inside.size() == posts.size()) return make(posts, height_m, sediment);
  std::ranges::fill(height_m, kNone);
  std::ranges::fill(sediment, std::uint8_t{0});
  if (inside.size() == 0) return;
  std::vector<float> made_m(inside.size());
  std::vector<std::uint8_t> made_sediment(inside.size());
  make(inside, made_m, made_sediment);
  const auto columns = static_cast<std::size_t>(inside.columns);
  for (std::size_t row = 0; row < static_cast<std::size_t>(inside.rows); ++row) {
    const std::size_t to = (static_cast<std::size_t>(inside.first_north - posts.first_north) + row) *
                               static_cast<std::size_t>(posts.columns) +
                           static_cast<std::size_t>(inside.first_east - posts.first_east);
    std::copy_n(&made_m[row * columns], columns, &height_m[to]);
    std::copy_n(&made_sediment[row * columns], columns, &sediment[to]);
  }
}

void LayersSource::make(const PostBlock& posts, std::span<float> height_m, std::span<std::uint8_t> sediment) const {
  if (posts.spacing_m == description_.post_spacing_m) {
    fields_.seabed.fill({0, posts.first_east, posts.first_north, posts.columns, posts.rows}, height_m, sediment);
    return;
  }
  const int level = std::max(0, static_cast<int>(std::floor(std::log2(posts.spacing_m / description_.post_spacing_m))));
  const terrain::Tile tile =
      tile_of(window_around(level, description_.post_spacing_m, {posts.east_m(0), posts.north_m(0)},
                            {posts.east_m(posts.columns - 1), posts.north_m(posts.rows - 1)}));
  std::size_t k = 0;
  for (int row = 0; row < posts.rows; ++row) {
    for (int column = 0; column < posts.columns; ++column, ++k) {
      const Vec2 place(posts.east_m(column), posts.north_m(row));
      height_m[k] = static_cast<float>(terrain::height_m(tile, place).value_or(kNone));
      sediment[k] = terrain::sediment_at(tile, place);
    }
  }
}

double LayersSource::height_m(const Vec2& place) const {
  if (!extent_.contains(place)) return kNone;
  constexpr std::int64_t kSide = 64;  // posts made at a time: neighbours are asked for next
  const std::scoped_lock lock(mutex_);
  if (near_) {
    if (const auto height = terrain::height_m(*near_, place)) return *height;
  }
  const auto first = [&](double m) {
    return static_cast<std::int64_t>(std::floor(m / (static_cast<double>(kSide) * description_.post_spacing_m))) *
           kSide;
  };
  terrain::Tile tile = tile_of({0, first(place.x()), first(place.y()), kSide + 1, kSide + 1});
  for (float& height : tile.height_m) height = terrain::on_lattice(height, description_.lsb_m);
  near_ = std::make_shared<const terrain::Tile>(std::move(tile));
  return terrain::height_m(*near_, place).value_or(kNone);
}

}  // namespace ensonify::source
