#include "tools/terrain/import/mesh_cells.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "components/config/config_error.h"
#include "components/errors/exit_error.h"
#include "components/terrain/mesh_file.h"
#include "tools/terrain/import/cell_grid.h"
#include "tools/terrain/import/values.h"

namespace ensonify::terrain_import {
namespace {

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

}  // namespace

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

}  // namespace ensonify::terrain_import
