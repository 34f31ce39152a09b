#pragma once

#include <array>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "kernels/base/frames/local_projection.h"

class GDALDataset;
class OGRSpatialReference;

namespace ensonify::source {

/// A part of the globe, degrees; east may be less than west, across the antimeridian.
struct GeodeticBox {
  double west_deg = 0.0;
  double south_deg = 0.0;
  double east_deg = 0.0;
  double north_deg = 0.0;
};

/// Options for reading a raster file.
struct RasterOptions {
  std::string path;
  std::string called;  // by messages; "" is the path
  int band = 1;
  /// Used instead of the file's own; "" takes the file's; "plane" takes metres east and north on the world's own map,
  /// with the raster's middle at `plane_origin`.
  std::string crs;
  std::optional<frames::Geodetic> plane_origin;
  std::optional<GeodeticBox> box;                                  // only the cells that it touches
  bool values_are_depths = false;                                  // positive down; else elevations, positive up
  std::optional<double> nodata;                                    // used instead of the file's own
  bool fill_holes = false;                                         // interpolate over them
  double fill_distance_cells = 100;                                // how far
  bool judge_values = true;                                        // refuse what cannot be a seabed's heights in metres
  std::string cutting = "first (gdal_translate -projwin)";         // how a part of it is cut out
  std::string crs_setting = "the pager's `raster_crs: EPSG:...`";  // what sets `crs`, as its user knows it
};

/// Description of its values in a file, as far as given.
struct RasterHints {
  std::string unit;            // GDAL's word: "m", "ft", "us-ft", "fathom"; "" when nothing is said
  std::string words;           // names and descriptions of the band, lower case
  std::string vertical;        // name of the vertical reference system
  bool vertical_down = false;  // its axis points down
  bool whole_numbers = false;  // values are of an integer type
};

/// A rectangle of cells of a raster, from its upper left corner.
struct CellWindow {
  int column = 0;
  int row = 0;
  int columns = 0;
  int rows = 0;
};

/// The files that a raster stands in, those beside it that belong to it included; none for what is in memory, or that
/// GDAL cannot read.
std::vector<std::string> files_of_raster(const std::string& path);

/// A raster of heights (or of other values at places) in the map of its own reference system. Any format that GDAL
/// reads; cells may be oblong, rotated or sheared against the map.
///
/// Throws ConfigError, naming the file, the cause and what is allowed, when it cannot be read, has no reference system,
/// holds no valid cell or holds depths where elevations were promised.
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
  const std::string& name() const { return options_.called.empty() ? options_.path : options_.called; }
  const RasterHints& hints() const { return hints_; }
  const RasterOptions& options() const { return options_; }
  /// As files_of_raster.
  std::vector<std::string> files() const;

  /// Map coordinates of a cell; its centre has whole numbers.
  std::array<double, 2> map_of(double column, double row) const;
  /// The reverse. A longitude may be off by whole turns.
  std::array<double, 2> cell_of(double map_x, double map_y) const;

  /// Elevations in m, up; NaN where there is no value. Any thread.
  void read(const CellWindow& window, std::span<float> elevation_m) const;
  /// All cells, row by row from the upper left.
  std::vector<float> read_all() const;
  /// From now on these are the raster's cells. Call before the file is shared with other threads.
  void hold(std::vector<float> elevation_m);

  /// The mistake of a user: "FILE: message".
  [[noreturn]] void refuse(const std::string& message) const;

 private:
  void open();
  void open_finest();
  std::unique_ptr<GDALDataset, void (*)(GDALDataset*)> refinements(double from_m, double to_m, double cell_m) const;
  std::vector<float> read_refinements() const;
  void read_geotransform();
  void invert_geotransform();
  void read_reference();
  void read_hints();
  void cut(const GeodeticBox& box);
  void measure();
  void judge(std::size_t valid, std::size_t above) const;

  RasterOptions options_;
  std::unique_ptr<GDALDataset, void (*)(GDALDataset*)> dataset_;
  std::unique_ptr<OGRSpatialReference, void (*)(OGRSpatialReference*)> reference_;
  RasterHints hints_;
  bool refined_ = false;  // a BAG of variable resolution; dataset_ is the grid of its finest cells
  std::array<double, 6> map_from_cell_{0, 1, 0, 0, 0, 1};  // GDAL's geotransform: of cells' corners
  std::array<double, 6> cell_from_map_{};
  double turn_ = 0.0;  // what longitudes repeat by; 0 on a projected map
  int columns_ = 0;
  int rows_ = 0;
  int first_column_ = 0, first_row_ = 0;  // of the file
  double lowest_m_ = 0.0;
  double highest_m_ = 0.0;
  std::vector<float> held_;
  mutable std::mutex mutex_;  // GDAL's datasets are not for several threads at once
};

/// Fills the NaN of a raster, row by row, from what lies around them: inverse distance weights of the nearest values in
/// each quadrant [GDAL's GDALFillNodata], then `smoothing` passes of a 3 x 3 mean over what was filled. Cells farther
/// than `distance_cells` from any value stay NaN. Filled cells lie between the values that they came from.
///
/// Gives GDAL's complaint, or "" when all went well.
std::string fill_holes(std::span<float> cells, int columns, int rows, double distance_cells, int smoothing = 0);

}  // namespace ensonify::source
