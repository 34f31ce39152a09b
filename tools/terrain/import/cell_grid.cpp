#include "tools/terrain/import/cell_grid.h"

#include <cpl_error.h>
#include <fmt/format.h>
#include <gdal_priv.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "components/errors/exit_error.h"

namespace ensonify::terrain_import {

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

}  // namespace ensonify::terrain_import
