#include "components/runtime/terrain/raster_file.h"

#include <cpl_error.h>
#include <gdal_alg.h>
#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "components/runtime/config/config_error.h"

namespace ensonify::source {
namespace {

/// Numbers that files without a nodata entry use for "no value".
constexpr std::array kUsualFills = {-9999.0, 9999.0, -99999.0, 99999.0, -32768.0, 32767.0, 1e6, -1e6};
constexpr double kDeepestOcean_m = 11'500.0;
constexpr double kHighestLand_m = 9'000.0;

void close(GDALDataset* dataset) { GDALClose(dataset); }
void release(OGRSpatialReference* reference) { reference->Release(); }

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

/// GDAL prints what goes wrong; we say it ourselves.
struct QuietErrors {
  QuietErrors() { CPLPushErrorHandler(CPLQuietErrorHandler); }
  ~QuietErrors() { CPLPopErrorHandler(); }
};

}  // namespace

RasterFile::RasterFile(RasterOptions options)
    : options_(std::move(options)), dataset_(nullptr, close), reference_(nullptr, release) {
  GDALAllRegister();
  const QuietErrors quiet;
  open();
  read_reference();
  const bool declared_depths = options_.values_are_depths;  // fill() leaves elevations
  if (options_.fill_holes) fill();
  check_values(declared_depths);
}

RasterFile::~RasterFile() = default;

void RasterFile::refuse(const std::string& message) const {
  throw ConfigError({ConfigProblem{{options_.path, 0, 0}, "", message}});
}

void RasterFile::open() {
  CPLErrorReset();
  dataset_.reset(GDALDataset::Open(options_.path.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR));
  if (!dataset_) {
    const std::string why = CPLGetLastErrorMsg();
    refuse("cannot be read as a raster (" + (why.empty() ? "unknown format" : why) +
           "); any format that GDAL reads is allowed: GeoTIFF, BAG, NetCDF, ASCII grid and others");
  }
  if (dataset_->GetRasterCount() == 0) {
    std::string names;
    char** entries = dataset_->GetMetadata("SUBDATASETS");
    for (int i = 0; entries != nullptr && entries[i] != nullptr; i += 2) {
      const std::string entry = entries[i];
      names += "\n  " + entry.substr(entry.find('=') + 1);
    }
    refuse(names.empty() ? "holds no raster band" : "holds several rasters; name one of them as the path:" + names);
  }
  if (options_.band < 1 || options_.band > dataset_->GetRasterCount()) {
    refuse("has no band " + std::to_string(options_.band) + "; allowed are 1 to " +
           std::to_string(dataset_->GetRasterCount()));
  }
  columns_ = dataset_->GetRasterXSize();
  rows_ = dataset_->GetRasterYSize();
  if (columns_ < 2 || rows_ < 2) {
    refuse("is only " + std::to_string(columns_) + " x " + std::to_string(rows_) + " cells; at least 2 x 2 are needed");
  }
  if (dataset_->GetGeoTransform(geotransform_) != CE_None) {
    refuse("is not georeferenced: it has no geotransform (origin and cell size)");
  }
  if (geotransform_[2] != 0.0 || geotransform_[4] != 0.0) {
    refuse("is rotated against its map (geotransform terms " + number(geotransform_[2]) + " and " +
           number(geotransform_[4]) + "); only rasters along the map's axes are allowed: warp it first (gdalwarp)");
  }
}

void RasterFile::read_reference() {
  const OGRSpatialReference* own = dataset_->GetSpatialRef();
  if (!options_.crs.empty()) {
    reference_.reset(new OGRSpatialReference);
    if (reference_->SetFromUserInput(options_.crs.c_str()) != OGRERR_NONE) {
      refuse("the reference system " + options_.crs + " is unknown; write it as EPSG:32619, a PROJ string or WKT");
    }
  } else if (own != nullptr) {
    reference_.reset(own->Clone());
  } else {
    refuse("has no coordinate reference system; name it with the pager's `raster_crs: EPSG:...`");
  }
  if (reference_->IsCompound()) reference_->StripVertical();
  if (!reference_->IsProjected() && !reference_->IsGeographic()) {
    refuse("has a reference system that is neither projected nor geographic (" +
           std::string(reference_->GetName() ? reference_->GetName() : "unnamed") +
           "); name one with the pager's `raster_crs: EPSG:...`");
  }
  reference_->SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
}

/// Keeps the band in memory with its holes interpolated [GDAL's inverse distance weights along eight directions].
void RasterFile::fill() {
  GDALDriver* memory = GetGDALDriverManager()->GetDriverByName("MEM");
  GDALDataset* filled = memory->Create("", columns_, rows_, 2, GDT_Float32, nullptr);
  if (filled == nullptr) refuse("is too large to have its holes filled in memory");
  std::unique_ptr<GDALDataset, void (*)(GDALDataset*)> keep(filled, close);
  filled->SetGeoTransform(geotransform_);

  std::vector<float> line(static_cast<std::size_t>(columns_));
  std::vector<float> mask(line.size());
  for (int row = 0; row < rows_; ++row) {
    read({0, row, columns_, 1}, line);
    for (std::size_t i = 0; i < line.size(); ++i) {
      mask[i] = std::isnan(line[i]) ? 0.0F : 1.0F;
      if (std::isnan(line[i])) line[i] = 0.0F;
    }
    const auto put = [&](int band, std::vector<float>& values) {
      return filled->GetRasterBand(band)->RasterIO(GF_Write, 0, row, columns_, 1, values.data(), columns_, 1,
                                                   GDT_Float32, 0, 0, nullptr);
    };
    if (put(1, line) != CE_None || put(2, mask) != CE_None) refuse("could not be copied into memory");
  }
  // What lies beyond the reach of the filling stays a hole: mark it before, find it after.
  constexpr float kHole = std::numeric_limits<float>::lowest();
  for (int row = 0; row < rows_; ++row) {
    auto* height = filled->GetRasterBand(1);
    auto* valid = filled->GetRasterBand(2);
    if (valid->RasterIO(GF_Read, 0, row, columns_, 1, mask.data(), columns_, 1, GDT_Float32, 0, 0, nullptr) !=
            CE_None ||
        height->RasterIO(GF_Read, 0, row, columns_, 1, line.data(), columns_, 1, GDT_Float32, 0, 0, nullptr) !=
            CE_None) {
      refuse("could not be read back from memory");
    }
    for (std::size_t i = 0; i < line.size(); ++i) {
      if (mask[i] == 0.0F) line[i] = kHole;
    }
    if (height->RasterIO(GF_Write, 0, row, columns_, 1, line.data(), columns_, 1, GDT_Float32, 0, 0, nullptr) !=
        CE_None) {
      refuse("could not be copied into memory");
    }
  }
  if (GDALFillNodata(filled->GetRasterBand(1), filled->GetRasterBand(2), options_.fill_distance_cells, 0, 0, nullptr,
                     nullptr, nullptr) != CE_None) {
    refuse(std::string("its holes cannot be filled: ") + CPLGetLastErrorMsg());
  }
  filled->GetRasterBand(1)->SetNoDataValue(kHole);
  dataset_ = std::move(keep);
  options_.band = 1;
  options_.nodata.reset();
  options_.values_are_depths = false;  // read() has turned them already
}

void RasterFile::read(const CellWindow& w, std::span<float> elevation_m) const {
  const std::scoped_lock lock(mutex_);
  const QuietErrors quiet;
  GDALRasterBand* band = dataset_->GetRasterBand(options_.band);
  if (band->RasterIO(GF_Read, w.column, w.row, w.columns, w.rows, elevation_m.data(), w.columns, w.rows, GDT_Float32, 0,
                     0, nullptr) != CE_None) {
    refuse("cells from column " + std::to_string(w.column) + ", row " + std::to_string(w.row) +
           " cannot be read: " + CPLGetLastErrorMsg());
  }
  int has_nodata = 0;
  const double own_nodata = band->GetNoDataValue(&has_nodata);
  const bool check_nodata = options_.nodata.has_value() || has_nodata != 0;
  const auto nodata = static_cast<float>(options_.nodata.value_or(own_nodata));
  const auto scale = static_cast<float>(band->GetScale() * (options_.values_are_depths ? -1.0 : 1.0));
  const auto offset = static_cast<float>(band->GetOffset() * (options_.values_are_depths ? -1.0 : 1.0));
  for (float& value : elevation_m) {
    const bool hole = !std::isfinite(value) || (check_nodata && value == nodata);
    value = hole ? std::numeric_limits<float>::quiet_NaN() : value * scale + offset;
  }
}

void RasterFile::check_values(bool declared_depths) {
  std::size_t valid = 0, above = 0;
  lowest_m_ = std::numeric_limits<double>::max();
  highest_m_ = std::numeric_limits<double>::lowest();
  std::vector<float> line(static_cast<std::size_t>(columns_));
  for (int row = 0; row < rows_; ++row) {
    read({0, row, columns_, 1}, line);
    for (const float value : line) {
      if (std::isnan(value)) continue;
      ++valid;
      above += value > 0.0F ? 1 : 0;
      lowest_m_ = std::min<double>(lowest_m_, value);
      highest_m_ = std::max<double>(highest_m_, value);
    }
  }
  if (valid == 0) refuse("holds no valid cell: all are nodata or NaN");
  const std::string range = "from " + number(lowest_m_) + " to " + number(highest_m_) + " m";
  for (const double fill : kUsualFills) {
    const double seen = declared_depths ? -fill : fill;
    if (lowest_m_ == seen || highest_m_ == seen) {
      refuse(
          "holds " + number(fill) +
          ", which looks like a mark for missing values but is not declared as one; set the pager's `raster_nodata: " +
          number(fill) + "`");
    }
  }
  if (lowest_m_ < -kDeepestOcean_m || highest_m_ > kHighestLand_m) {
    refuse("holds heights " + range + "; between " + number(-kDeepestOcean_m) + " and " + number(kHighestLand_m) +
           " m are allowed (a mark for missing values is declared with the pager's `raster_nodata`)");
  }
  if (2 * above > valid) {
    refuse("is mostly above the water (heights " + range + " up): " +
           (declared_depths ? "its values are elevations or land; `seabed.raster.values: elevation` reads them as such"
                            : "its values are depths or land; `seabed.raster.values: depth` reads them as depths") +
           ", land alone cannot be surveyed");
  }
}

}  // namespace ensonify::source
