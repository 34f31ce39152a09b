#include "tools/grid/product.h"

#include <cpl_conv.h>
#include <cpl_error.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gdal_priv.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>

#include "components/errors/exit_error.h"

namespace ensonify::grid_tool {
namespace {

using survey_grid::CellSums;
using survey_grid::SoundingGrid;

constexpr std::int64_t kMostCells = 2'000'000'000;
constexpr std::int64_t kMostBagCells = 300'000'000;  // made in memory
constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
constexpr float kBagNone = 1e6F;  // the format's own word for no value

/// What stands in a band, of a cell with soundings.
struct Band {
  const char* description;
  const char* unit;
  double (*value)(const CellSums& cell);
};

const Band kElevation{"elevation, m, up from the vertical datum (mean of the soundings, weighted by 1 / sd^2)", "metre",
                      [](const CellSums& cell) { return -cell.weighted_m(); }};
const Band kUncertainty{"uncertainty of the elevation, m, 95 % (the larger of what is stated and observed)", "metre",
                        [](const CellSums& cell) { return cell.uncertainty_m(); }};
const std::array<Band, 5> kBands{
    kElevation,
    Band{"elevation of the shoalest sounding, m, up", "metre", [](const CellSums& cell) { return -cell.shoalest_m(); }},
    Band{"number of soundings", "1", [](const CellSums& cell) { return static_cast<double>(cell.count()); }},
    Band{"standard deviation of the soundings, m", "metre", [](const CellSums& cell) { return cell.sd_m(); }},
    kUncertainty};

[[noreturn]] void lost(const std::string& file) {
  const int cause = errno;
  const std::string said = CPLGetLastErrorMsg();
  throw DataLost(fmt::format("{}: cannot be written: {}", file, said.empty() ? std::strerror(cause) : said));
}

struct Close {
  void operator()(GDALDataset* dataset) const { GDALClose(dataset); }
};
using Dataset = std::unique_ptr<GDALDataset, Close>;

GDALDriver& driver(const char* name) {
  GDALAllRegister();
  GDALDriver* found = GetGDALDriverManager()->GetDriverByName(name);
  if (found == nullptr) throw UserError(fmt::format("this GDAL has no driver {}", name));
  return *found;
}

SoundingGrid::Frame frame_of(const SoundingGrid& grid, std::int64_t most_cells) {
  const SoundingGrid::Frame frame = grid.frame();
  if (frame.columns == 0) throw UserError("the files hold no accepted sounding");
  if (frame.columns > most_cells / frame.rows)
    throw UserError(fmt::format("--cell {:g}: makes {} x {} cells; at most {} are allowed: use larger ones",
                                grid.cell_m(), frame.columns, frame.rows, most_cells));
  return frame;
}

/// Writes rows from the north.
void fill(GDALDataset& dataset, int number, const Band& band, const SoundingGrid& grid,
          const SoundingGrid::Frame& frame, float none, const std::string& file) {
  GDALRasterBand& raster = *dataset.GetRasterBand(number);
  raster.SetDescription(band.description);
  raster.SetUnitType(band.unit);
  std::vector<float> row(static_cast<std::size_t>(frame.columns));
  for (std::int64_t k = 0; k < frame.rows; ++k) {
    for (std::int64_t i = 0; i < frame.columns; ++i) {
      const CellSums& cell = grid.at(frame.first_column + i, frame.first_row + frame.rows - 1 - k);
      const double value = cell.count() == 0 ? std::numeric_limits<double>::quiet_NaN() : band.value(cell);
      row[static_cast<std::size_t>(i)] = std::isnan(value) ? none : static_cast<float>(value);
    }
    if (raster.RasterIO(GF_Write, 0, static_cast<int>(k), static_cast<int>(frame.columns), 1, row.data(),
                        static_cast<int>(frame.columns), 1, GDT_Float32, 0, 0, nullptr) != CE_None)
      lost(file);
  }
}

void georeference(GDALDataset& dataset, const SoundingGrid& grid, const SoundingGrid::Frame& frame,
                  const ProductFacts& facts) {
  const double cell_m = grid.cell_m();
  std::array<double, 6> transform{static_cast<double>(frame.first_column) * cell_m,           cell_m, 0.0,
                                  static_cast<double>(frame.first_row + frame.rows) * cell_m, 0.0,    -cell_m};
  dataset.SetGeoTransform(transform.data());
  if (!facts.crs_wkt.empty()) dataset.SetProjection(facts.crs_wkt.c_str());
}

std::string sources_text(const ProductFacts& facts) {
  std::vector<std::string> names;
  for (const std::string& source : facts.sources) names.push_back(std::filesystem::path(source).filename().string());
  return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace

void write_geotiff(const std::string& file, const SoundingGrid& grid, const ProductFacts& facts) {
  const SoundingGrid::Frame frame = frame_of(grid, kMostCells);
  CPLStringList options;
  for (const char* option : {"COMPRESS=DEFLATE", "PREDICTOR=3", "TILED=YES", "INTERLEAVE=BAND", "BIGTIFF=IF_SAFER"})
    options.AddString(option);
  const Dataset dataset(driver("GTiff").Create(file.c_str(), static_cast<int>(frame.columns),
                                               static_cast<int>(frame.rows), static_cast<int>(kBands.size()),
                                               GDT_Float32, options.List()));
  if (!dataset) lost(file);
  georeference(*dataset, grid, frame, facts);
  dataset->SetMetadataItem("VERTICAL_DATUM", facts.datum.c_str());
  dataset->SetMetadataItem("SOURCES", sources_text(facts).c_str());
  dataset->SetMetadataItem("ENSONIFY_VERSION", facts.version.c_str());
  dataset->SetMetadataItem("CELL_SIZE_M", fmt::format("{}", grid.cell_m()).c_str());
  for (int number = 1; number <= static_cast<int>(kBands.size()); ++number) {
    dataset->GetRasterBand(number)->SetNoDataValue(static_cast<double>(kNone));
    fill(*dataset, number, kBands[static_cast<std::size_t>(number - 1)], grid, frame, kNone, file);
  }
  dataset->FlushCache();
  if (CPLGetLastErrorType() >= CE_Failure) lost(file);
}

void write_bag(const std::string& file, const SoundingGrid& grid, const ProductFacts& facts) {
  const SoundingGrid::Frame frame = frame_of(grid, kMostBagCells);
  if (facts.crs_wkt.empty()) throw UserError(file + ": a BAG needs a map, and the files do not state where they are");
  const Dataset memory(
      driver("MEM").Create("", static_cast<int>(frame.columns), static_cast<int>(frame.rows), 2, GDT_Float32, nullptr));
  if (!memory) lost(file);
  georeference(*memory, grid, frame, facts);
  fill(*memory, 1, kElevation, grid, frame, kBagNone, file);
  fill(*memory, 2, kUncertainty, grid, frame, kBagNone, file);
  for (const int band : {1, 2}) memory->GetRasterBand(band)->SetNoDataValue(static_cast<double>(kBagNone));
  CPLStringList options;
  options.SetNameValue("VAR_ABSTRACT", ("Simulated survey, gridded by Ensonify from " + sources_text(facts)).c_str());
  options.SetNameValue(
      "VAR_PROCESS_STEP_DESCRIPTION",
      fmt::format("ensonify grid {}: cells of {} m, weighted mean", facts.version, grid.cell_m()).c_str());
  options.SetNameValue("VAR_VERTICAL_UNCERT_CODE", "productUncert");
  std::string datum = facts.datum.empty() ? "unknown" : facts.datum;
  std::replace(datum.begin(), datum.end(), '"', '\'');  // a word of WKT
  options.SetNameValue("VAR_VERT_WKT",
                       fmt::format("VERT_CS[\"{0}\",VERT_DATUM[\"{0}\",2005],UNIT[\"metre\",1]]", datum).c_str());
  // HDF5 ends the program where the disk is full: the file is made in memory, and written by us.
  const std::string made = "/vsimem/ensonify_grid.bag";
  Dataset dataset(driver("BAG").CreateCopy(made.c_str(), memory.get(), 0, options.List(), nullptr, nullptr));
  if (!dataset) lost(file);
  dataset.reset();
  vsi_l_offset bytes = 0;
  const GByte* content = VSIGetMemFileBuffer(made.c_str(), &bytes, 0);
  std::ofstream out(file, std::ios::binary);
  out.write(reinterpret_cast<const char*>(content), static_cast<std::streamsize>(bytes));
  out.close();
  VSIUnlink(made.c_str());
  if (!out) {
    CPLErrorReset();
    lost(file);
  }
}

}  // namespace ensonify::grid_tool
