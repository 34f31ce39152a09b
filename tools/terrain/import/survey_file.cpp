#include "tools/terrain/import/survey_file.h"

#include <fmt/format.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "components/terrain/mesh_file.h"
#include "tools/terrain/import/points.h"

namespace ensonify::terrain_import {
namespace {

/// Direction of the stripes on the map, which may be one of degrees.
double azimuth_deg(const source::RasterFile& raster, double along_rad) {
  const double column = raster.columns() / 2.0, row = raster.rows() / 2.0;
  const auto here = raster.map_of(column, row);
  const auto there = raster.map_of(column + std::cos(along_rad), row + std::sin(along_rad));
  double east = there[0] - here[0];
  if (raster.reference().IsGeographic()) east *= std::cos(here[1] * raster.reference().GetAngularUnits());
  const double azimuth = std::atan2(east, there[1] - here[1]) * 180.0 / std::numbers::pi;
  return azimuth < 0.0 ? azimuth + 180.0 : azimuth >= 180.0 ? azimuth - 180.0 : azimuth;
}

void clean(const CleanOptions& options, survey_grid::Surface& surface, SurveyFile& file) {
  file.spikes = survey_grid::spikes_of(surface);
  file.despiked = options.despike;
  if (options.despike) {
    for (const auto& spike : file.spikes) {
      surface.height_m[static_cast<std::size_t>(spike.row) * static_cast<std::size_t>(surface.columns) +
                       static_cast<std::size_t>(spike.column)] = std::numeric_limits<float>::quiet_NaN();
    }
  }
  file.stripes = survey_grid::stripes_of(surface);
  if (file.stripes.found) {
    file.stripes_azimuth_deg = azimuth_deg(*file.raster, file.stripes.along_rad);
    if (options.destripe) file.destriped_cells = survey_grid::remove_stripes(surface, file.stripes);
  }
  file.band = survey_grid::band_of(surface);
  file.removed_below_cells = options.band_start_cells == kBandAuto ? file.band.begins_cells : options.band_start_cells;
  if (file.removed_below_cells <= 2.0) file.removed_below_cells = 0.0;
  if (file.removed_below_cells > 0.0) survey_grid::remove_shorter_waves(surface, file.removed_below_cells);
}

std::shared_ptr<source::RasterFile> opened(const source::RasterOptions& options) {
  auto raster = std::make_shared<source::RasterFile>(options);
  const double cells = static_cast<double>(raster->columns()) * raster->rows();
  if (cells > kMostCells) {
    raster->refuse(fmt::format("has {} x {} cells; at most {:.0e} are held in memory: cut out the survey area {}",
                               raster->columns(), raster->rows(), kMostCells, kCutting));
  }
  return raster;
}

}  // namespace

source::RasterOptions raster_options(const FileOptions& file, const std::optional<frames::Geodetic>& origin,
                                     const std::optional<source::GeodeticBox>& box) {
  source::RasterOptions options;
  options.path = file.path;
  options.band = file.band;
  options.crs = file.crs;
  options.plane_origin = origin;
  options.box = box;
  options.judge_values = false;
  options.crs_setting = kCrsSetting;
  options.cutting = kCutting;
  return options;
}

SurveyFile read_survey_file(const FileOptions& file, const ImportOptions& options, int number) {
  SurveyFile survey;
  survey.options = file;
  source::RasterOptions how = raster_options(file, options.origin, options.box);
  const bool mesh = source::is_mesh_file(file.path);
  if (mesh || is_scattered(file.path)) {
    how.path = fmt::format("/vsimem/ensonify-import/{}.tif", number);
    how.called = file.path;
    survey.points = mesh ? grid_mesh(file, options.points, how.path) : grid_points(file, options.points, how.path);
    survey.files = {file.path};
  }
  auto raster = opened(how);
  if (!survey.points) survey.files = raster->files();
  survey.raster = raster;
  survey_grid::Surface surface{raster->columns(), raster->rows(), 1.0, raster->read_all()};
  survey.values = elevations_of(*raster, file, surface.height_m);
  survey.known_cells =
      std::count_if(surface.height_m.begin(), surface.height_m.end(), [](float h) { return !std::isnan(h); });
  clean(options.clean, surface, survey);
  raster->hold(std::move(surface.height_m));
  return survey;
}

void thin(SurveyFile& file, double cells_per_post) {
  const double cells = 2.0 * cells_per_post;
  if (cells_per_post < 1.5 || cells <= file.removed_below_cells) return;
  auto raster = std::const_pointer_cast<source::RasterFile>(file.raster);
  survey_grid::Surface surface{raster->columns(), raster->rows(), 1.0, raster->read_all()};
  survey_grid::remove_shorter_waves(surface, cells);
  file.removed_below_cells = cells;
  raster->hold(std::move(surface.height_m));
}

}  // namespace ensonify::terrain_import
