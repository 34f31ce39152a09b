#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

class GDALDataset;
class OGRSpatialReference;

namespace ensonify::source {

/// How to read a raster file.
struct RasterOptions {
  std::string path;
  int band = 1;
  std::string crs;                   // used instead of the file's own; "" takes the file's
  bool values_are_depths = false;    // positive down; else elevations, positive up
  std::optional<double> nodata;      // used instead of the file's own
  bool fill_holes = false;           // interpolate over them
  double fill_distance_cells = 100;  // how far
};

/// A rectangle of cells of a raster, from its upper left corner.
struct CellWindow {
  int column = 0;
  int row = 0;
  int columns = 0;
  int rows = 0;
};

/// A raster of heights in the map of its own reference system, cells along the map's axes. Any format that GDAL reads.
///
/// Throws ConfigError, naming the file, the cause and what is allowed, when it cannot be read, has no reference system,
/// is rotated, holds no valid cell or holds depths where elevations were promised.
class RasterFile {
 public:
  explicit RasterFile(RasterOptions options);
  ~RasterFile();

  int columns() const { return columns_; }
  int rows() const { return rows_; }
  /// Horizontal reference system, x east (or longitude), y north (or latitude).
  const OGRSpatialReference& reference() const { return *reference_; }
  double lowest_m() const { return lowest_m_; }
  double highest_m() const { return highest_m_; }
  const std::string& path() const { return options_.path; }

  /// Map coordinates of the centre of a cell.
  double map_x(double column) const { return geotransform_[0] + (column + 0.5) * geotransform_[1]; }
  double map_y(double row) const { return geotransform_[3] + (row + 0.5) * geotransform_[5]; }
  /// The reverse: a cell's centre has whole numbers.
  double column_of(double map_x) const { return (map_x - geotransform_[0]) / geotransform_[1] - 0.5; }
  double row_of(double map_y) const { return (map_y - geotransform_[3]) / geotransform_[5] - 0.5; }

  /// Elevations in m, up; NaN where there is no value. Any thread.
  void read(const CellWindow& window, std::span<float> elevation_m) const;

  /// The mistake of a user: "FILE: message".
  [[noreturn]] void refuse(const std::string& message) const;

 private:
  void open();
  void read_reference();
  void fill();
  void check_values(bool declared_depths);

  RasterOptions options_;
  std::unique_ptr<GDALDataset, void (*)(GDALDataset*)> dataset_;
  std::unique_ptr<OGRSpatialReference, void (*)(OGRSpatialReference*)> reference_;
  double geotransform_[6] = {0, 1, 0, 0, 0, 1};
  int columns_ = 0;
  int rows_ = 0;
  double lowest_m_ = 0.0;
  double highest_m_ = 0.0;
  mutable std::mutex mutex_;  // GDAL's datasets are not for several threads at once
};

}  // namespace ensonify::source
