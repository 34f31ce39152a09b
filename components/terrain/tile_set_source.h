#pragma once

#include <list>
#include <memory>
#include <mutex>
#include <string>

#include "components/terrain/terrain_source.h"
#include "components/terrain/tiles/tile_set.h"

namespace ensonify::source {

/// A tile set seen as a terrain. At the set's own spacing posts are the stored ones, to the bit; at any other, and
/// between posts, heights are bilinear and classes those of the nearest post. A few decoded tiles are kept.
class TileSetSource : public TerrainSource {
 public:
  /// Throws ConfigError for a folder that holds no set.
  explicit TileSetSource(const std::string& folder);
  /// A set whose manifest may not be written yet.
  explicit TileSetSource(tiles::TileSet set);

  Extent extent() const override { return extent_; }
  double lowest_m() const override { return lowest_m_; }
  double highest_m() const override { return highest_m_; }
  frames::Geodetic origin() const override { return set_.origin; }
  double native_spacing_m() const override { return set_.grid.spacing_m; }
  std::optional<double> lsb_m() const override { return set_.grid.lsb_m; }
  /// Throws tiles::TileError for a damaged file.
  void sample(const PostBlock& posts, std::span<float> height_m, std::span<std::uint8_t> sediment) const override;
  /// The one that is kept with the set; of a set without one, or with one that is damaged, all tiles are read.
  Overview overview() const override;
  double height_m(const Vec2& place) const override;

  /// Class of the nearest post; 0 where the set has no tile.
  std::uint8_t sediment(const Vec2& place) const;

  const tiles::TileSet& set() const { return set_; }

 private:
  using TilePtr = std::shared_ptr<const terrain::Tile>;
  struct Kept {
    terrain::TileKey key;
    TilePtr tile;
  };

  /// Nothing where the set has no tile.
  TilePtr tile_at(const terrain::TileKey& key) const;

  /// Part of sample(): columns from `first` to before `behind`.
  void sample_columns(const PostBlock& posts, int first, int behind, std::span<float> height_m,
                      std::span<std::uint8_t> sediment) const;

  /// The tile whose posts these are, all and no others; nothing if there is none.
  TilePtr whole_tile(const PostBlock& posts) const;

  tiles::TileSet set_;
  Extent extent_;
  double lowest_m_ = 0.0, highest_m_ = 0.0;
  mutable std::mutex mutex_;
  mutable std::list<Kept> kept_;  // the last used first
};

/// Fault of tiles of this origin in a world whose origin is `site`: "", or where the two are if they are more
/// than 0.1 mm apart. Tiles are squares of the world's own lattice and cannot be moved.
std::string fault_of_origin(const frames::Geodetic& tiles, const frames::Geodetic& site);

}  // namespace ensonify::source
