#pragma once

#include <memory>
#include <mutex>

#include "components/terrain/layered_seabed.h"
#include "components/terrain/terrain_source.h"
#include "kernels/base/frames/local_projection.h"
#include "scenarios/world/seabed.h"

namespace ensonify::source {

/// A seabed of layers, made when it is asked for and cut off at a rectangle. At its own spacing posts are the seabed's;
/// at a wider one they are taken, bilinear, from the level of the lattice just finer, which lacks what it cannot show.
class LayersSource : public TerrainSource {
 public:
  /// Throws ConfigError as fields_of does.
  LayersSource(const Seabed& seabed, const frames::Geodetic& origin);

  Extent extent() const override { return extent_; }
  /// As far as 256 x 256 places show.
  double lowest_m() const override { return lowest_m_; }
  double highest_m() const override { return highest_m_; }
  frames::Geodetic origin() const override { return origin_; }
  double native_spacing_m() const override { return description_.post_spacing_m; }
  void sample(const PostBlock& posts, std::span<float> height_m, std::span<std::uint8_t> sediment) const override;
  MeshedRelief meshed_relief() const override { return source::meshed_relief(description_, fields_); }
  /// Bilinear between posts on the lattice of heights, as a tile of them is.
  double height_m(const Vec2& place) const override;

 private:
  void make(const PostBlock& posts, std::span<float> height_m, std::span<std::uint8_t> sediment) const;
  terrain::Tile tile_of(const relief::Window& window) const;
  void probe();

  Seabed description_;
  LayeredFields fields_;
  Extent extent_;
  frames::Geodetic origin_;
  double lowest_m_ = 0.0, highest_m_ = 0.0;
  mutable std::mutex mutex_;
  mutable std::shared_ptr<const terrain::Tile> near_;  // posts around the place last asked for
};

}  // namespace ensonify::source
