#include "tools/terrain/import/points.h"

#include <cpl_error.h>
#include <fmt/format.h>
#include <gdal_alg.h>
#include <gdal_priv.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>
#include <vector>

#include "components/errors/exit_error.h"
#include "tools/terrain/import/cell_grid.h"
#include "tools/terrain/import/values.h"

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

}  // namespace ensonify::terrain_import
