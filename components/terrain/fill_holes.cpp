#include "components/terrain/fill_holes.h"

#include <cpl_conv.h>
#include <cpl_error.h>
#include <cpl_string.h>
#include <gdal_alg.h>
#include <gdal_priv.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

namespace ensonify::source {
namespace {

void close(GDALDataset* dataset) { GDALClose(dataset); }

/// Adds a band whose pixels are this memory.
bool add_band(GDALDataset& dataset, void* data, GDALDataType type) {
  char pointer[64] = {};
  CPLPrintPointer(pointer, data, sizeof pointer - 1);
  CPLStringList options;
  options.SetNameValue("DATAPOINTER", pointer);
  return dataset.AddBand(type, options.List()) == CE_None;
}

}  // namespace

std::string fill_holes(std::span<float> cells, int columns, int rows, double distance_cells, int smoothing) {
  CPLErrorReset();
  GDALAllRegister();
  GDALDriver* memory = GetGDALDriverManager()->GetDriverByName("MEM");
  const std::unique_ptr<GDALDataset, void (*)(GDALDataset*)> dataset(
      memory->Create("", columns, rows, 0, GDT_Float32, nullptr), close);
  std::vector<std::uint8_t> known(cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i) known[i] = std::isnan(cells[i]) ? 0 : 1;
  CPLStringList options;
  options.SetNameValue("TEMP_FILE_DRIVER", "MEM");
  const bool filled = dataset && add_band(*dataset, cells.data(), GDT_Float32) &&
                      add_band(*dataset, known.data(), GDT_Byte) &&
                      GDALFillNodata(dataset->GetRasterBand(1), dataset->GetRasterBand(2), distance_cells, 0, smoothing,
                                     options.List(), nullptr, nullptr) == CE_None;
  if (filled) return "";
  const std::string why = CPLGetLastErrorMsg();
  return why.empty() ? "not enough memory" : why;
}

}  // namespace ensonify::source
