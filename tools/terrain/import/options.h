#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "components/terrain/raster_file.h"

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

}  // namespace ensonify::terrain_import
