#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "components/terrain/raster_file.h"
#include "kernels/survey/grid/defects.h"
#include "kernels/survey/grid/stripes.h"

namespace ensonify::terrain_import {

/// Options for one file, or for all of them.
struct FileOptions {
  std::string path;
  std::string crs;                // instead of the file's own; "plane"; "" takes the file's
  std::string positive = "auto";  // up, down
  std::string units = "auto";     // m, cm, mm, dm, ft, us-ft, fathom
  std::vector<double> nodata;     // marks of missing values, besides the file's own
  double datum_shift_m = 0.0;     // added to elevations
  std::string vertical;           // a raster of what is added to elevations, place by place
  int band = 1;
};

enum class PointMethod { kMean, kLowest, kHighest, kLinear };

/// Options for making cells of what is no raster.
struct PointOptions {
  PointMethod method = PointMethod::kMean;
  double cell_m = 0.0;  // 0: such that a cell holds four points on the average
};

/// Treatment of a survey's artefacts, in the file's own cells.
struct CleanOptions {
  bool despike = false;   // spikes become holes
  bool destripe = false;  // bands along survey lines are taken out
  /// Waves shorter than this are taken out; 0: none, kBandAuto: those that the file was found to be smoothed below.
  double band_start_cells = 0.0;
};
inline constexpr double kBandAuto = -1.0;

struct FillOptions {
  enum class Method { kNone, kIdw, kSmooth };
  Method method = Method::kNone;
  double reach_m = 0.0;  // holes that reach farther from what is known stay holes
};

/// Source of the sediment classes of posts; the first that knows one decides: class raster, backscatter, rules.
struct SedimentOptions {
  std::uint8_t otherwise = 0;
  std::string class_raster;
  std::map<int, std::uint8_t> class_of_value;  // empty: a value is a class
  std::string backscatter;
  std::vector<double> thresholds_db;              // rising
  std::vector<std::uint8_t> backscatter_classes;  // one more than thresholds; empty: 0, 1, 2 ...
  std::vector<std::string> rules;                 // "CLASS:depth>30,slope<5"
};

struct ImportOptions {
  std::vector<FileOptions> files;          // the first that knows a place decides
  std::optional<frames::Geodetic> origin;  // else the middle of the data
  std::optional<source::GeodeticBox> box;
  double spacing_m = 0.0;  // 0: the finest file's own
  double lsb_m = 0.0;      // 0: the finest of 0.2, 0.5, 1, 2, 4, 10 ... mm that holds the relief
  PointOptions points;
  CleanOptions clean;
  FillOptions fill;
  SedimentOptions sediment;
};

/// Conversion of a file's values to elevations in metres, up.
struct ValueFacts {
  bool down = false;     // they were depths
  std::string down_why;  // who said so
  double unit_m = 1.0;   // metres in one of them
  std::string unit;
  std::int64_t marked = 0;  // cells that the user's marks made holes
  double lowest_m = 0.0, highest_m = 0.0;
};

/// Turns the values of a file into elevations, in place, before any datum: marks of missing values, sign, unit.
///
/// Sign "auto": values of which more than half are negative are elevations, for as depths they would be dry; others are
/// what the file says (the axis of its vertical reference system, an attribute `positive`, a name with "depth",
/// "elevation", "altitude" or "height" in it); a file that says nothing, or both, is refused.
/// Unit "auto": what the file says, else metres. Refused with place, cause and what is allowed: marks of missing values
/// that are not declared, heights that no planet of ours has, whole numbers that ran over their type.
ValueFacts elevations_of(const source::RasterFile& file, const FileOptions& options, std::span<float> values);

/// Holes where a value is one of the marks; how many there were.
std::int64_t drop_marked(std::span<float> values, const std::vector<double>& marks);

/// Refuses marks of missing values that are at an end of the values' range.
void refuse_usual_marks(const source::RasterFile& file, double lowest, double highest);

/// Metres in a unit; throws UserError, beginning with `who`, for an unknown one.
double metres_in(const std::string& unit, const std::string& who);

/// The whole text as a number; nothing if it is none.
std::optional<double> number_in(const std::string& text);

/// Numbers with commas between; throws UserError, beginning with `option`, unless there are from `least` to `most`.
std::vector<double> numbers_in(const std::string& text, const std::string& option, std::size_t least, std::size_t most);

/// A file as it stands on the command line: "PATH" or "PATH?key=value&key=value", with what is said of all files for
/// the rest. Keys: crs, positive, units, nodata (with commas), datum-shift, vertical, band. Throws UserError.
FileOptions file_of(const std::string& words, FileOptions all);

/// Result of gridding scattered points.
struct PointFacts {
  std::int64_t points = 0;
  std::string method;
  double cell_m = 0.0;
  std::int64_t cells = 0;        // that got a value
  double widest_spread_m = 0.0;  // between the lowest and the highest point of one cell: overhangs, walls, outliers
};

/// True for a text of places and heights that is no regular grid, which GDAL's XYZ driver therefore refuses.
bool is_scattered(const std::string& path);

/// Makes cells of points: the mean, lowest or highest of those within a cell (cells without points are holes), or the
/// plane through the three points of Delaunay's triangle around a cell's centre [GDAL's gdal_grid, "linear"], nothing
/// beyond their hull. Writes a raster that GDAL can open at `raster_path` (in memory).
///
/// A line is x y z, with blanks, commas or semicolons between, more columns allowed and ignored; a first line that
/// starts with a letter is a header. Throws UserError with file and line for anything else.
PointFacts grid_points(const FileOptions& file, const PointOptions& options, const std::string& raster_path);

/// Makes cells of a mesh, OBJ or PLY, x to the east, y to the north: the highest of its surfaces over each cell's
/// middle; cells without are holes. What lies under another surface is lost; `widest_spread_m` is the farthest that it
/// lies below. All three axes are in the file's units (FileOptions::units, else metres). Writes a raster as
/// grid_points does.
PointFacts grid_mesh(const FileOptions& file, const PointOptions& options, const std::string& raster_path);

/// Square cells over a rectangle of a map, row by row from the south; NaN at first.
struct CellGrid {
  double west = 0.0, south = 0.0;  // of the first cell's corner
  double cell = 1.0;               // side
  int columns = 0, rows = 0;
  std::vector<float> cells;

  /// Covers a rectangle. Throws UserError, beginning with `who`, when that takes more than kMostCells.
  CellGrid(const std::string& who, double west, double south, double east, double north, double cell);

  /// The cell that holds a place of the rectangle.
  std::size_t cell_at(double x, double y) const;
  /// As a GeoTIFF without a reference system, NaN for nodata. Throws UserError.
  void write(const std::string& path) const;
};

/// Cells of one raster and posts of one tile set that are held in memory, some 20 bytes each.
inline constexpr double kMostCells = 1e8;
/// Cells of one raster that the stored seabed is compared with.
inline constexpr double kComparedCells = 1e6;

/// One file as elevations in its own cells, and what happened on the way.
struct SurveyFile {
  std::shared_ptr<const source::RasterFile> raster;
  FileOptions options;
  std::vector<std::string> files;  // that it was read from
  std::optional<PointFacts> points;
  ValueFacts values;
  std::int64_t known_cells = 0;
  /// Cells as the file has them, before anything is taken out of them: all, or as many of them evenly.
  struct Cell {
    std::int32_t column, row;
    float height_m;
  };
  std::vector<Cell> kept_cells;
  std::vector<survey_grid::Spike> spikes;
  bool despiked = false;
  survey_grid::Stripes stripes;
  double stripes_azimuth_deg = 0.0;  // clockwise from the map's north, 0..180
  std::int64_t destriped_cells = 0;
  survey_grid::Band band;
  double removed_below_cells = 0.0;  // waves that were taken out; 0: none
};

/// Name, for messages, of the option that sets a file's reference system.
inline constexpr const char* kCrsSetting = "--crs EPSG:... (or --crs plane --origin LAT,LON for metres on a plane)";

inline constexpr const char* kCutting = "with --bounds WEST,SOUTH,EAST,NORTH (degrees)";

/// Options for opening a file, or another raster beside it.
source::RasterOptions raster_options(const FileOptions& file, const std::optional<frames::Geodetic>& origin,
                                     const std::optional<source::GeodeticBox>& box);

/// Reads a file, searches for spikes, stripes and smoothing in its own cells, and does about them what was asked. Its
/// heights do not hold its datum yet. Throws UserError for what cannot be imported. `number` distinguishes it from
/// others.
SurveyFile read_survey_file(const FileOptions& file, const ImportOptions& options, int number);

/// Takes out waves shorter than two posts, if posts lie farther apart than cells; what is there already is kept.
void thin(SurveyFile& file, double cells_per_post);

}  // namespace ensonify::terrain_import
