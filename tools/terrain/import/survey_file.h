#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "kernels/survey/grid/defects.h"
#include "kernels/survey/grid/stripes.h"
#include "tools/terrain/import/options.h"
#include "tools/terrain/import/points.h"
#include "tools/terrain/import/values.h"

namespace ensonify::terrain_import {

/// One file as elevations in its own cells, and what happened on the way.
struct SurveyFile {
  std::shared_ptr<const source::RasterFile> raster;
  FileOptions options;
  std::vector<std::string> files;  // that it was read from
  std::optional<PointFacts> points;
  ValueFacts values;
  std::int64_t known_cells = 0;
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
