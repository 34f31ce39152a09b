#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "components/terrain/meshed_relief.h"
#include "kernels/base/frames/local_projection.h"
#include "kernels/mesh/tile.h"

namespace ensonify::source {

using frames::Vec2;

/// A rectangle in the world frame, m.
struct Extent {
  double west_m = 0.0;
  double south_m = 0.0;
  double east_m = 0.0;
  double north_m = 0.0;

  bool contains(const Vec2& place) const {
    return place.x() >= west_m && place.x() <= east_m && place.y() >= south_m && place.y() <= north_m;
  }
};

/// Posts (first_east + i, first_north + j) of a lattice through the world's origin.
struct PostBlock {
  std::int64_t first_east = 0;
  std::int64_t first_north = 0;
  int columns = 0;  // to the east
  int rows = 0;     // to the north
  double spacing_m = 1.0;

  std::size_t size() const { return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows); }
  double east_m(int column) const { return static_cast<double>(first_east + column) * spacing_m; }
  double north_m(int row) const { return static_cast<double>(first_north + row) * spacing_m; }
};

/// The posts of a terrain's overview: the lattice of 256 over the longer side of its extent.
PostBlock overview_posts(const Extent& extent);

/// A terrain as a whole, as charts show it.
struct Overview {
  PostBlock posts;              // overview_posts of its extent
  std::vector<float> height_m;  // as sample() has them
  std::string fault;            // why one that was kept could not be used, and these heights were made anew; or ""
};

/// Source of heights: a raster or a generator. All functions are pure and may be called from any thread.
class TerrainSource {
 public:
  virtual ~TerrainSource() = default;

  /// The smallest rectangle outside which nothing is known.
  virtual Extent extent() const = 0;
  /// Lowest and highest height, ENU z, m.
  virtual double lowest_m() const = 0;
  virtual double highest_m() const = 0;
  /// Place of the world's origin on the ellipsoid.
  virtual frames::Geodetic origin() const = 0;
  /// Distance between posts that loses nothing worth keeping, m.
  virtual double native_spacing_m() const = 0;
  /// The step that all heights are whole multiples of, m, where they are.
  virtual std::optional<double> lsb_m() const { return std::nullopt; }

  /// Heights (ENU z, m; NaN where nothing is known) and sediment classes, row by row from the south-west. The value of
  /// a post depends on its place in the lattice only, so blocks that share posts agree bit by bit.
  virtual void sample(const PostBlock& posts, std::span<float> height_m, std::span<std::uint8_t> sediment) const = 0;
  /// The same of overview_posts(extent()), the heights.
  virtual Overview overview() const;
  /// Slopes of facets between its posts by the sediments' relief, where it knows what its heights are made of.
  virtual MeshedRelief meshed_relief() const { return {}; }
  /// Height at one place; NaN where nothing is known.
  virtual double height_m(const Vec2& place) const = 0;
};

/// The posts of a tile on its set's lattice of heights, whether it is baked or made on page-in: grid.cells + 1 per
/// side, row by row from the south-west, NaN where there is none.
void fill_tile(const TerrainSource& source, const terrain::TileGrid& grid, const terrain::TileKey& key,
               std::span<float> height_m, std::span<std::uint8_t> sediment);

}  // namespace ensonify::source
