#include "components/terrain/tile_set_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "components/terrain/tiles/overview.h"
#include "components/terrain/tiles/tile_set.h"

namespace ensonify::source {
namespace {

constexpr std::size_t kKeptTiles = 8;  // 6 MB each at 1025 x 1025 posts

std::string place_text(const frames::Geodetic& place) {
  return fmt::format("{:.9f}, {:.9f} deg", place.latitude_deg, place.longitude_deg);
}

}  // namespace

TileSetSource::TileSetSource(const std::string& folder) : TileSetSource(tiles::open_tile_set(folder)) {}

TileSetSource::TileSetSource(tiles::TileSet set) : set_(std::move(set)) {
  constexpr double kFar = std::numeric_limits<double>::max();
  extent_ = {kFar, kFar, -kFar, -kFar};
  lowest_m_ = kFar;
  highest_m_ = -kFar;
  for (const auto& [key, facts] : set_.tiles) {
    const Vec2 corner = set_.grid.origin_of(key);
    extent_.west_m = std::min(extent_.west_m, corner.x());
    extent_.south_m = std::min(extent_.south_m, corner.y());
    extent_.east_m = std::max(extent_.east_m, corner.x() + set_.grid.side_m());
    extent_.north_m = std::max(extent_.north_m, corner.y() + set_.grid.side_m());
    lowest_m_ = std::min(lowest_m_, facts.lowest_m);
    highest_m_ = std::max(highest_m_, facts.highest_m);
  }
}

TileSetSource::TilePtr TileSetSource::tile_at(const terrain::TileKey& key) const {
  if (!set_.tiles.contains(key)) return nullptr;
  const auto kept = [&]() -> TilePtr {
    const auto found = std::find_if(kept_.begin(), kept_.end(), [&](const Kept& k) { return k.key == key; });
    if (found == kept_.end()) return nullptr;
    kept_.splice(kept_.begin(), kept_, found);
    return found->tile;
  };
  {
    const std::scoped_lock lock(mutex_);
    if (auto tile = kept()) return tile;
  }
  auto tile = std::make_shared<const terrain::Tile>(tiles::read_tile(set_, key));  // unlocked: threads decode together
  const std::scoped_lock lock(mutex_);
  if (auto other = kept()) return other;
  kept_.push_front({key, tile});
  if (kept_.size() > kKeptTiles) kept_.pop_back();
  return tile;
}

TileSetSource::TilePtr TileSetSource::whole_tile(const PostBlock& posts) const {
  const std::int64_t cells = set_.grid.cells;
  if (posts.spacing_m != set_.grid.spacing_m || posts.columns != cells + 1 || posts.rows != cells + 1) return nullptr;
  if (posts.first_east % cells != 0 || posts.first_north % cells != 0) return nullptr;
  return tile_at(
      {static_cast<std::int32_t>(posts.first_east / cells), static_cast<std::int32_t>(posts.first_north / cells)});
}

void TileSetSource::sample(const PostBlock& posts, std::span<float> height_m, std::span<std::uint8_t> sediment) const {
  if (const TilePtr tile = whole_tile(posts)) {
    std::ranges::copy(tile->height_m, height_m.begin());
    std::ranges::copy(tile->sediment, sediment.begin());
    return;
  }
  // From tile to tile, not row by row over all of them: each is decoded once.
  for (int first = 0, behind = 0; first < posts.columns; first = behind) {
    const auto tile_of = [&](int column) { return set_.grid.key_at({posts.east_m(column), posts.north_m(0)}).east; };
    for (behind = first + 1; behind < posts.columns && tile_of(behind) == tile_of(first);) ++behind;
    sample_columns(posts, first, behind, height_m, sediment);
  }
}

void TileSetSource::sample_columns(const PostBlock& posts, int first, int behind, std::span<float> height_m,
                                   std::span<std::uint8_t> sediment) const {
  const bool own = posts.spacing_m == set_.grid.spacing_m;
  terrain::TileKey held{std::numeric_limits<std::int32_t>::min(), 0};
  TilePtr tile;
  const auto hold = [&](const terrain::TileKey& key) {
    if (key == held) return;
    held = key;
    tile = tile_at(key);
  };
  for (int row = 0; row < posts.rows; ++row) {
    for (int column = first; column < behind; ++column) {
      const std::size_t k =
          static_cast<std::size_t>(row) * static_cast<std::size_t>(posts.columns) + static_cast<std::size_t>(column);
      height_m[k] = std::numeric_limits<float>::quiet_NaN();
      sediment[k] = 0;
      if (own) {
        const std::int64_t cells = set_.grid.cells, east = posts.first_east + column, north = posts.first_north + row;
        const auto tile_of = [cells](std::int64_t post) {
          return static_cast<std::int32_t>((post >= 0 ? post : post - cells + 1) / cells);
        };
        // The last post of a tile is the first of the next, which may not exist.
        terrain::TileKey key{tile_of(east), tile_of(north)};
        if (!set_.tiles.contains(key) && east % cells == 0 && set_.tiles.contains({key.east - 1, key.north}))
          --key.east;
        if (!set_.tiles.contains(key) && north % cells == 0) {
          if (set_.tiles.contains({key.east, key.north - 1})) --key.north;
          else if (east % cells == 0 && set_.tiles.contains({key.east - 1, key.north - 1})) --key.east, --key.north;
        }
        hold(key);
        if (!tile) continue;
        const std::size_t post = tile->post(static_cast<std::int32_t>(east - key.east * cells),
                                            static_cast<std::int32_t>(north - key.north * cells));
        height_m[k] = tile->height_m[post];
        sediment[k] = tile->sediment[post];
      } else {
        const Vec2 place(posts.east_m(column), posts.north_m(row));
        hold(set_.grid.key_at(place));
        if (!tile) continue;
        if (const auto height = terrain::height_m(*tile, place)) height_m[k] = static_cast<float>(*height);
        sediment[k] = terrain::sediment_at(*tile, place);
      }
    }
  }
}

Overview TileSetSource::overview() const {
  if (set_.overview_sha256.empty()) return TerrainSource::overview();
  std::string fault;
  try {
    tiles::Overview kept = tiles::read_overview(set_);
    const PostBlock posts = overview_posts(extent_);
    if (kept.columns == posts.columns && kept.rows == posts.rows) return {posts, std::move(kept.height_m), ""};
    fault = fmt::format("{}/{}: is not of {} x {} posts", set_.folder, tiles::kOverview, posts.rows, posts.columns);
  } catch (const tiles::TileError& error) {
    fault = error.what();
  }
  Overview made = TerrainSource::overview();
  made.fault = fault;
  return made;
}

double TileSetSource::height_m(const Vec2& place) const {
  const auto tile = tile_at(set_.grid.key_at(place));
  const auto height = tile ? terrain::height_m(*tile, place) : std::nullopt;
  return height ? *height : std::numeric_limits<double>::quiet_NaN();
}

std::uint8_t TileSetSource::sediment(const Vec2& place) const {
  const auto tile = tile_at(set_.grid.key_at(place));
  return tile ? terrain::sediment_at(*tile, place) : std::uint8_t{0};
}

std::string fault_of_origin(const frames::Geodetic& tiles, const frames::Geodetic& site) {
  constexpr double kSame_deg = 1e-9;  // 0.1 mm
  if (std::abs(tiles.latitude_deg - site.latitude_deg) <= kSame_deg &&
      std::abs(tiles.longitude_deg - site.longitude_deg) <= kSame_deg)
    return "";
  return "is " + place_text(tiles) + ", and the scenario's site is " + place_text(site);
}

}  // namespace ensonify::source
