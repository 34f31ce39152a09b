#include "tools/terrain/import/survey_file.h"

#include <cpl_error.h>
#include <fmt/format.h>
#include <gdal_alg.h>
#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "components/config/config_error.h"
#include "components/errors/exit_error.h"
#include "components/terrain/mesh_file.h"

namespace ensonify::terrain_import {
namespace {

struct Points {
  std::vector<double> x, y, z;
};

Points read_points(const FileOptions& options) {
  std::ifstream stream(options.path);
  if (!stream) throw UserError(options.path + ": cannot be read");
  Points points;
  std::string line;
  for (int n = 1; std::getline(stream, line); ++n) {
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    if (n == 1 && std::isalpha(static_cast<unsigned char>(line[line.find_first_not_of(" \t\"")])) != 0) continue;
    std::replace_if(
        line.begin(), line.end(), [](char c) { return c == ',' || c == ';'; }, ' ');
    double value[3] = {};
    const char* at = line.c_str();
    for (double& v : value) {
      char* end = nullptr;
      v = std::strtod(at, &end);
      if (end == at) throw UserError(fmt::format("{}:{}: is no point; allowed are lines of x y z", options.path, n));
      at = end;
    }
    if (!std::isfinite(value[0]) || !std::isfinite(value[1]))
      throw UserError(fmt::format("{}:{}: is no place; x and y must be finite numbers", options.path, n));
    const bool marked = std::find(options.nodata.begin(), options.nodata.end(), value[2]) != options.nodata.end();
    if (marked || !std::isfinite(value[2])) continue;
    points.x.push_back(value[0]), points.y.push_back(value[1]), points.z.push_back(value[2]);
  }
  if (points.z.size() < 4)
    throw UserError(
        fmt::format("{}: holds {} points with a value; at least 4 are needed", options.path, points.z.size()));
  return points;
}

/// One number a cell out of the points in it.
void bin(const Points& points, PointMethod method, CellGrid& grid, PointFacts& facts) {
  std::vector<float> lowest(grid.cells.size(), std::numeric_limits<float>::max());
  std::vector<float> highest(grid.cells.size(), std::numeric_limits<float>::lowest());
  std::vector<double> sum(grid.cells.size(), 0.0);
  std::vector<std::int32_t> count(grid.cells.size(), 0);
  for (std::size_t i = 0; i < points.z.size(); ++i) {
    const std::size_t cell = grid.cell_at(points.x[i], points.y[i]);
    const auto z = static_cast<float>(points.z[i]);
    lowest[cell] = std::min(lowest[cell], z), highest[cell] = std::max(highest[cell], z);
    sum[cell] += points.z[i];
    ++count[cell];
  }
  for (std::size_t cell = 0; cell < count.size(); ++cell) {
    if (count[cell] == 0) continue;
    ++facts.cells;
    facts.widest_spread_m = std::max<double>(facts.widest_spread_m, highest[cell] - lowest[cell]);
    grid.cells[cell] = method == PointMethod::kLowest    ? lowest[cell]
                       : method == PointMethod::kHighest ? highest[cell]
                                                         : static_cast<float>(sum[cell] / count[cell]);
  }
}

void triangulate(const Points& points, const std::string& name, CellGrid& grid, PointFacts& facts) {
  GDALGridLinearOptions options{};
  options.nSizeOfStructure = sizeof options;
  options.dfRadius = 0.0;  // nothing beyond the hull
  options.dfNoDataValue = std::numeric_limits<double>::quiet_NaN();
  CPLErrorReset();
  if (GDALGridCreate(GGA_Linear, &options, static_cast<GUInt32>(points.z.size()), points.x.data(), points.y.data(),
                     points.z.data(), grid.west, grid.west + grid.columns * grid.cell, grid.south,
                     grid.south + grid.rows * grid.cell, static_cast<GUInt32>(grid.columns),
                     static_cast<GUInt32>(grid.rows), GDT_Float32, grid.cells.data(), nullptr, nullptr) != CE_None) {
    throw UserError(name + ": its points cannot be triangulated: " + CPLGetLastErrorMsg());
  }
  facts.cells = std::count_if(grid.cells.begin(), grid.cells.end(), [](float z) { return !std::isnan(z); });
}

using frames::Vec2;
using frames::Vec3;

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Each cell whose middle lies over the triangle, its rim included, with the height there.
template <class Found>
void for_cells_under(const Vec3& a, const Vec3& b, const Vec3& c, const CellGrid& grid, Found found) {
  const Vec2 from_a = (b - a).head<2>(), to_c = (c - a).head<2>();
  const double area = cross(from_a, to_c);
  if (area == 0.0) return;  // upright
  const auto first = [&](double least, double origin) {
    return std::max(0, static_cast<int>(std::ceil((least - origin) / grid.cell - 0.5)));
  };
  const auto last = [&](double most, double origin, int count) {
    return std::min(count - 1, static_cast<int>(std::floor((most - origin) / grid.cell - 0.5)));
  };
  const auto [west, east] = std::minmax({a.x(), b.x(), c.x()});
  const auto [south, north] = std::minmax({a.y(), b.y(), c.y()});
  for (int row = first(south, grid.south); row <= last(north, grid.south, grid.rows); ++row) {
    for (int column = first(west, grid.west); column <= last(east, grid.west, grid.columns); ++column) {
      const Vec2 at(grid.west + (column + 0.5) * grid.cell - a.x(), grid.south + (row + 0.5) * grid.cell - a.y());
      const double to_b = cross(at, to_c) / area, to_third = cross(from_a, at) / area;
      if (to_b < -1e-12 || to_third < -1e-12 || to_b + to_third > 1.0 + 1e-12) continue;
      found(static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.columns) + static_cast<std::size_t>(column),
            a.z() + to_b * (b.z() - a.z()) + to_third * (c.z() - a.z()));
    }
  }
}

source::MeshFile read(const FileOptions& file) {
  try {
    return source::read_mesh_file(file.path);
  } catch (const ConfigError& error) {
    throw UserError(error.what());
  }
}

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

/// Every nth cell along rows and columns, so that there are no more than are compared.
std::vector<SurveyFile::Cell> some_of(const survey_grid::Surface& surface) {
  const double cells = static_cast<double>(surface.columns) * surface.rows;
  const int every = std::max(1, static_cast<int>(std::ceil(std::sqrt(cells / kComparedCells))));
  std::vector<SurveyFile::Cell> kept;
  for (int row = 0; row < surface.rows; row += every) {
    for (int column = 0; column < surface.columns; column += every) {
      const float height_m =
          surface.height_m[static_cast<std::size_t>(row) * static_cast<std::size_t>(surface.columns) +
                           static_cast<std::size_t>(column)];
      if (!std::isnan(height_m)) kept.push_back({column, row, height_m});
    }
  }
  return kept;
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

bool is_scattered(const std::string& path) {
  const std::string ending = std::filesystem::path(path).extension();
  if (ending != ".xyz" && ending != ".txt" && ending != ".csv" && ending != ".pts") return false;
  GDALAllRegister();
  CPLPushErrorHandler(CPLQuietErrorHandler);
  GDALDataset* dataset = GDALDataset::Open(path.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY);
  CPLPopErrorHandler();
  if (dataset != nullptr) GDALClose(dataset);
  return dataset == nullptr && std::filesystem::exists(path);
}

PointFacts grid_points(const FileOptions& file, const PointOptions& options, const std::string& raster_path) {
  const Points points = read_points(file);
  const auto [west, east] = std::minmax_element(points.x.begin(), points.x.end());
  const auto [south, north] = std::minmax_element(points.y.begin(), points.y.end());
  constexpr std::array kNames = {"mean", "lowest", "highest", "linear"};
  PointFacts facts;
  facts.method = kNames[static_cast<std::size_t>(options.method)];
  facts.points = static_cast<std::int64_t>(points.z.size());
  facts.cell_m =
      options.cell_m > 0.0
          ? options.cell_m
          : std::sqrt(4.0 * std::max(1e-6, (*east - *west) * (*north - *south)) / static_cast<double>(facts.points));
  CellGrid grid(file.path, *west, *south, *east, *north, facts.cell_m);
  if (options.method == PointMethod::kLinear) triangulate(points, file.path, grid, facts);
  else bin(points, options.method, grid, facts);
  grid.write(raster_path);
  return facts;
}

PointFacts grid_mesh(const FileOptions& file, const PointOptions& options, const std::string& raster_path) {
  source::MeshFile mesh = read(file);
  const double unit_m = file.units == "auto" ? 1.0 : metres_in(file.units, file.path);
  Eigen::AlignedBox2d around;
  for (Vec3& place : mesh.vertex) {
    place.head<2>() *= unit_m;  // heights keep the unit, as those of any file
    around.extend(Vec2(place.head<2>()));
  }
  PointFacts facts;
  facts.method = "highest surface of " + std::to_string(mesh.triangle.size()) + " triangles";
  facts.points = static_cast<std::int64_t>(mesh.vertex.size());
  // By default as many cells as there are vertices.
  facts.cell_m = options.cell_m > 0.0
                     ? options.cell_m
                     : std::sqrt(std::max(1e-6, around.volume()) / static_cast<double>(mesh.vertex.size()));
  CellGrid grid(file.path, around.min().x(), around.min().y(), around.max().x(), around.max().y(), facts.cell_m);
  std::vector<double> lowest(grid.cells.size(), std::numeric_limits<double>::infinity());
  for (const auto& [a, b, c] : mesh.triangle) {
    for_cells_under(mesh.vertex[a], mesh.vertex[b], mesh.vertex[c], grid, [&](std::size_t cell, double z) {
      lowest[cell] = std::min(lowest[cell], z);
      if (!(static_cast<double>(grid.cells[cell]) >= z)) grid.cells[cell] = static_cast<float>(z);
    });
  }
  for (std::size_t cell = 0; cell < lowest.size(); ++cell) {
    if (!std::isfinite(lowest[cell])) continue;
    ++facts.cells;
    facts.widest_spread_m =
        std::max(facts.widest_spread_m, unit_m * (static_cast<double>(grid.cells[cell]) - lowest[cell]));
  }
  grid.write(raster_path);
  return facts;
}

CellGrid::CellGrid(const std::string& who, double west_end, double south_end, double east_end, double north_end,
                   double side)
    : west(west_end), south(south_end), cell(side) {
  const double across = std::floor((east_end - west_end) / side) + 1.0;
  const double up = std::floor((north_end - south_end) / side) + 1.0;
  if (across * up > kMostCells) {
    throw UserError(
        fmt::format("{}: would take {:.0f} x {:.0f} cells of {:.6g}; at most {:.0e} are allowed: use larger "
                    "cells (--points-cell)",
                    who, across, up, side, kMostCells));
  }
  columns = static_cast<int>(across);
  rows = static_cast<int>(up);
  cells.assign(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows),
               std::numeric_limits<float>::quiet_NaN());
}

std::size_t CellGrid::cell_at(double x, double y) const {
  const int column = std::clamp(static_cast<int>((x - west) / cell), 0, columns - 1);
  const int row = std::clamp(static_cast<int>((y - south) / cell), 0, rows - 1);
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column);
}

void CellGrid::write(const std::string& path) const {
  GDALAllRegister();
  CPLErrorReset();
  GDALDataset* file =
      GetGDALDriverManager()->GetDriverByName("GTiff")->Create(path.c_str(), columns, rows, 1, GDT_Float32, nullptr);
  if (file == nullptr) throw UserError(path + ": cannot be written: " + CPLGetLastErrorMsg());
  double geotransform[6] = {west, cell, 0.0, south, 0.0, cell};
  file->SetGeoTransform(geotransform);
  file->GetRasterBand(1)->SetNoDataValue(std::numeric_limits<double>::quiet_NaN());
  const bool written = file->GetRasterBand(1)->RasterIO(GF_Write, 0, 0, columns, rows, const_cast<float*>(cells.data()),
                                                        columns, rows, GDT_Float32, 0, 0, nullptr) == CE_None;
  GDALClose(file);
  if (!written) throw UserError(path + ": cannot be written: " + CPLGetLastErrorMsg());
}

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
  survey.kept_cells = some_of(surface);
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
