#pragma once

#include <memory>
#include <mutex>
#include <optional>

#include "components/terrain/raster_file.h"
#include "components/terrain/terrain_source.h"

class OGRCoordinateTransformation;

namespace ensonify::source {

/// A raster file seen from the world: each post is looked up in the raster's own map and interpolated bilinearly
/// between the four cells around it, or takes the nearest cell's value (classes). Beyond the outermost cells' centres,
/// and beside a hole when interpolating, nothing is known.
///
/// Posts are carried into the raster's map exactly at every 16th post of the lattice and bilinearly between those: off
/// by less than 1e-4 of a cell for posts up to 10 m apart.
class RasterSource : public TerrainSource {
 public:
  /// Without an origin the raster's centre becomes the world's origin. `sediment` is the class everywhere.
  RasterSource(RasterOptions options, std::optional<frames::Geodetic> origin, std::uint8_t sediment = 0);
  enum class Between { kBilinear, kNearest };
  RasterSource(std::shared_ptr<const RasterFile> file, std::optional<frames::Geodetic> origin,
               Between between = Between::kBilinear, std::uint8_t sediment = 0);
  ~RasterSource() override;

  Extent extent() const override { return extent_; }
  double lowest_m() const override { return file_->lowest_m(); }
  double highest_m() const override { return file_->highest_m(); }
  frames::Geodetic origin() const override { return origin_; }
  double native_spacing_m() const override { return native_spacing_m_; }
  /// Area of one of the raster's cells, in its middle, m2.
  double cell_area_m2() const { return cell_area_m2_; }
  void sample(const PostBlock& posts, std::span<float> height_m, std::span<std::uint8_t> sediment) const override;
  double height_m(const Vec2& place) const override;
  /// The middle of a cell; NaN where the maps do not lead there.
  Vec2 place_of(int column, int row) const;

 private:
  using Transformation = std::unique_ptr<OGRCoordinateTransformation, void (*)(OGRCoordinateTransformation*)>;
  struct CellGrid;

  frames::Geodetic centre() const;
  void connect_maps();
  void measure();
  Transformation clone(const Transformation& transformation) const;
  CellGrid cells_of(const PostBlock& posts) const;

  std::shared_ptr<const RasterFile> file_;
  Between between_;
  std::uint8_t sediment_;
  frames::Geodetic origin_;
  Transformation map_from_enu_;
  Transformation enu_from_map_;
  mutable std::mutex mutex_;  // guards cloning: a transformation is for one thread
  Extent extent_;
  double native_spacing_m_ = 1.0;
  double cell_area_m2_ = 1.0;
};

}  // namespace ensonify::source
