#include "components/terrain/raster_file.h"

#include <cpl_conv.h>
#include <cpl_error.h>
#include <cpl_string.h>
#include <gdal_alg.h>
#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <limits>

#include "components/config/config_error.h"

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

std::vector<std::string> files_of(GDALDataset& dataset) {
  std::vector<std::string> names;
  char** list = dataset.GetFileList();
  for (int i = 0; list != nullptr && list[i] != nullptr; ++i) {
    if (std::string(list[i]).rfind("/vsi", 0) != 0) names.emplace_back(list[i]);
  }
  CSLDestroy(list);
  return names;
}

/// Adds a band whose pixels are this memory.
bool add_band(GDALDataset& dataset, void* data, GDALDataType type) {
  char pointer[64] = {};
  CPLPrintPointer(pointer, data, sizeof pointer - 1);
  CPLStringList options;
  options.SetNameValue("DATAPOINTER", pointer);
  return dataset.AddBand(type, options.List()) == CE_None;
}

/// Width of a cell in units of its map; 0 where it has none.
double cell_width(GDALDataset& dataset) {
  double geotransform[6] = {};
  return dataset.GetGeoTransform(geotransform) == CE_None ? std::hypot(geotransform[1], geotransform[4]) : 0.0;
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

std::vector<std::string> files_of_raster(const std::string& path) {
  GDALAllRegister();
  const QuietErrors quiet;
  const std::unique_ptr<GDALDataset, void (*)(GDALDataset*)> dataset(
      GDALDataset::Open(path.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY), close);
  return dataset ? files_of(*dataset) : std::vector<std::string>{};
}

RasterFile::RasterFile(RasterOptions options)
    : options_(std::move(options)), dataset_(nullptr, close), reference_(nullptr, release) {
  GDALAllRegister();
  const QuietErrors quiet;
  open();
  read_geotransform();
  read_reference();
  read_hints();
  if (options_.box) cut(*options_.box);
  if (refined_) held_ = read_refinements();
  if (options_.fill_holes) {
    std::vector<float> cells = read_all();
    const std::string fault = source::fill_holes(cells, columns_, rows_, options_.fill_distance_cells);
    if (!fault.empty()) refuse("its holes cannot be filled: " + fault);
    hold(std::move(cells));
  } else {
    measure();
  }
}

RasterFile::~RasterFile() = default;

void RasterFile::refuse(const std::string& message) const {
  throw ConfigError({ConfigProblem{{name(), 0, 0}, "", message}});
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
  open_finest();
  columns_ = dataset_->GetRasterXSize();
  rows_ = dataset_->GetRasterYSize();
  if (columns_ < 2 || rows_ < 2) {
    refuse("is only " + std::to_string(columns_) + " x " + std::to_string(rows_) + " cells; at least 2 x 2 are needed");
  }
}

/// A BAG of variable resolution shows its overview, a few large cells; its refinements are read on the finest grid.
void RasterFile::open_finest() {
  const char* refined = dataset_->GetMetadataItem("HAS_SUPERGRIDS");  // not of every GDAL
  const char* finest = dataset_->GetMetadataItem("MIN_RESOLUTION_X");
  if ((refined == nullptr || !EQUAL(refined, "TRUE")) && finest == nullptr) return;
  refined_ = true;
  const double overview = cell_width(*dataset_);
  constexpr double kAny = 1e9;
  dataset_ = refinements(0.0, kAny, 0.0);
  const std::string why = dataset_ ? "" : std::string(": ") + CPLGetLastErrorMsg();
  const bool finer =
      finest == nullptr || CPLAtof(finest) >= 0.999 * overview || (dataset_ && cell_width(*dataset_) < overview);
  if (!dataset_ || !finer) {
    refuse("is of variable resolution, and GDAL here reads only its overview of " + number(overview) +
           " m cells, not its refinements" + (finest != nullptr ? " of " + std::string(finest) + " m and more" : "") +
           why + "; read it with a GDAL whose BAG driver has MODE=RESAMPLED_GRID, or resample it first");
  }
}

/// The refinements of cells larger than `from_m` and no larger than `to_m`, on a grid of `cell_m` (0: of their finest),
/// each of its cells the mean of theirs within it; nothing where there are none.
std::unique_ptr<GDALDataset, void (*)(GDALDataset*)> RasterFile::refinements(double from_m, double to_m,
                                                                             double cell_m) const {
  constexpr double kRounding = 1.001;  // cell sizes in the file are floats
  CPLStringList how;
  how.SetNameValue("MODE", "RESAMPLED_GRID");
  how.SetNameValue("VALUE_POPULATION", "MEAN");
  how.SetNameValue("RES_FILTER_MIN", number(kRounding * from_m).c_str());
  how.SetNameValue("RES_FILTER_MAX", number(kRounding * to_m).c_str());
  if (cell_m > 0.0) {
    how.SetNameValue("RESX", std::to_string(cell_m).c_str());
    how.SetNameValue("RESY", std::to_string(cell_m).c_str());
  } else {
    how.SetNameValue("RES_STRATEGY", "MIN");
  }
  CPLErrorReset();
  return {GDALDataset::Open(options_.path.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY, nullptr, how.List()), close};
}

/// GDAL puts each node of a refinement into one cell of its grid, so coarse ones would leave gaps in a fine grid. They
/// are read on grids of twice the cell size and so on, and stand for the fine cells that lie in theirs.
std::vector<float> RasterFile::read_refinements() const {
  constexpr int kMostLevels = 20;
  constexpr double kMostCells = 4e8;
  if (static_cast<double>(columns_) * rows_ > kMostCells)
    refuse("has " + number(columns_) + " x " + number(rows_) + " cells at its finest; at most " + number(kMostCells) +
           " are allowed: cut out the survey area " + options_.cutting);
  std::vector<float> cells(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_),
                           std::numeric_limits<float>::quiet_NaN());
  double below_m = 0.0;
  for (double cell_m = std::abs(map_from_cell_[1]); cell_m < std::ldexp(std::abs(map_from_cell_[1]), kMostLevels);
       below_m = cell_m, cell_m *= 2.0) {
    const auto level = refinements(below_m, cell_m, cell_m);
    double geotransform[6];
    if (!level || level->GetGeoTransform(geotransform) != CE_None) continue;
    GDALRasterBand* band = level->GetRasterBand(options_.band);
    const auto nodata = static_cast<float>(band->GetNoDataValue());
    std::vector<float> line(static_cast<std::size_t>(level->GetRasterXSize()));
    int read_row = -1;
    for (int row = 0; row < rows_; ++row) {
      const int from_row = static_cast<int>(std::floor((map_of(0, row)[1] - geotransform[3]) / geotransform[5]));
      if (from_row < 0 || from_row >= level->GetRasterYSize()) continue;
      if (from_row != read_row && band->RasterIO(GF_Read, 0, from_row, level->GetRasterXSize(), 1, line.data(),
                                                 level->GetRasterXSize(), 1, GDT_Float32, 0, 0, nullptr) != CE_None)
        refuse(std::string("its refinements cannot be read: ") + CPLGetLastErrorMsg());
      read_row = from_row;
      for (int column = 0; column < columns_; ++column) {
        const int from = static_cast<int>(std::floor((map_of(column, row)[0] - geotransform[0]) / geotransform[1]));
        float& cell = cells[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                            static_cast<std::size_t>(column)];
        if (from < 0 || from >= level->GetRasterXSize() || !std::isnan(cell)) continue;
        const float value = line[static_cast<std::size_t>(from)];
        if (std::isfinite(value) && value != nodata) cell = options_.values_are_depths ? -value : value;
      }
    }
  }
  return cells;
}

void RasterFile::read_geotransform() {
  if (dataset_->GetGeoTransform(map_from_cell_.data()) != CE_None) {
    refuse("is not georeferenced: it has no geotransform (origin and cell size)");
  }
  if (!std::all_of(map_from_cell_.begin(), map_from_cell_.end(), [](double g) { return std::isfinite(g); }))
    refuse("has a geotransform that holds a number which is none");
  invert_geotransform();
}

void RasterFile::invert_geotransform() {
  if (GDALInvGeoTransform(map_from_cell_.data(), cell_from_map_.data()) == 0) {
    refuse("has a geotransform that squeezes its cells to nothing");
  }
}

void RasterFile::read_reference() {
  const OGRSpatialReference* own = dataset_->GetSpatialRef();
  reference_.reset(new OGRSpatialReference);
  if (options_.crs == "plane") {
    if (!options_.plane_origin) refuse("lies on a plane of its own: where its middle is on the globe must be given");
    const auto [x, y] = map_of((columns_ - 1) / 2.0, (rows_ - 1) / 2.0);
    reference_->SetProjCS("plane");
    reference_->SetWellKnownGeogCS("WGS84");
    reference_->SetTM(options_.plane_origin->latitude_deg, options_.plane_origin->longitude_deg, 1.0, x, y);
  } else if (!options_.crs.empty()) {
    if (reference_->SetFromUserInput(options_.crs.c_str()) != OGRERR_NONE) {
      refuse("the reference system " + options_.crs + " is unknown; write it as EPSG:32619, a PROJ string or WKT");
    }
  } else if (own != nullptr) {
    reference_.reset(own->Clone());
  } else {
    refuse("has no coordinate reference system; name it with " + options_.crs_setting);
  }
  if (reference_->IsCompound()) {
    OGRAxisOrientation axis = OAO_Other;
    reference_->GetAxis("VERT_CS", 0, &axis);
    hints_.vertical_down = axis == OAO_Down;
    const char* name = reference_->GetAttrValue("VERT_CS");
    hints_.vertical = name != nullptr ? name : "";
    reference_->StripVertical();
  }
  if (!reference_->IsProjected() && !reference_->IsGeographic()) {
    refuse("has a reference system that is neither projected nor geographic (" +
           std::string(reference_->GetName() ? reference_->GetName() : "unnamed") + "); name one with " +
           options_.crs_setting);
  }
  reference_->SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  if (reference_->IsGeographic()) turn_ = 2.0 * std::acos(-1.0) / reference_->GetAngularUnits();
}

void RasterFile::read_hints() {
  GDALRasterBand* band = dataset_->GetRasterBand(options_.band);
  hints_.unit = band->GetUnitType();
  hints_.whole_numbers = GDALDataTypeIsInteger(band->GetRasterDataType()) != 0;
  hints_.words = band->GetDescription();
  for (const char* key : {"positive", "standard_name", "long_name", "NETCDF_VARNAME"}) {
    if (const char* word = band->GetMetadataItem(key)) hints_.words += std::string(" ") + key + "=" + word;
  }
  for (char& letter : hints_.words) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
}

/// Leaves the cells that a box touches; the box's sides bend on the map, so each is followed in 64 steps.
void RasterFile::cut(const GeodeticBox& box) {
  constexpr int kSteps = 64;
  const double turns_deg = box.east_deg < box.west_deg ? 360.0 : 0.0;
  std::vector<double> x, y;
  for (int k = 0; k <= kSteps; ++k) {
    const double t = static_cast<double>(k) / kSteps;
    const double along_deg = box.west_deg + t * (box.east_deg + turns_deg - box.west_deg);
    const double up_deg = box.south_deg + t * (box.north_deg - box.south_deg);
    for (const double latitude : {box.south_deg, box.north_deg}) x.push_back(along_deg), y.push_back(latitude);
    for (const double longitude : {box.west_deg, box.east_deg + turns_deg}) x.push_back(longitude), y.push_back(up_deg);
  }
  OGRSpatialReference geodetic;
  geodetic.SetWellKnownGeogCS("WGS84");
  geodetic.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  const std::unique_ptr<OGRCoordinateTransformation> map_from_geodetic(
      OGRCreateCoordinateTransformation(&geodetic, reference_.get()));
  if (!map_from_geodetic || !map_from_geodetic->Transform(static_cast<int>(x.size()), x.data(), y.data()))
    refuse(std::string("its reference system cannot be related to WGS 84: ") + CPLGetLastErrorMsg());
  double west = columns_, east = -1.0, upper = rows_, lower = -1.0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    const auto [column, row] = cell_of(x[k], y[k]);
    west = std::min(west, column), east = std::max(east, column);
    upper = std::min(upper, row), lower = std::max(lower, row);
  }
  const int first_column = static_cast<int>(std::clamp(std::floor(west), 0.0, columns_ - 1.0));
  const int first_row = static_cast<int>(std::clamp(std::floor(upper), 0.0, rows_ - 1.0));
  const int last_column = static_cast<int>(std::clamp(std::ceil(east), 0.0, columns_ - 1.0));
  const int last_row = static_cast<int>(std::clamp(std::ceil(lower), 0.0, rows_ - 1.0));
  if (last_column <= first_column || last_row <= first_row) refuse("has no cells in the bounds that are given");
  auto& g = map_from_cell_;
  g[0] += first_column * g[1] + first_row * g[2];
  g[3] += first_column * g[4] + first_row * g[5];
  invert_geotransform();
  first_column_ = first_column;
  first_row_ = first_row;
  columns_ = last_column - first_column + 1;
  rows_ = last_row - first_row + 1;
}

std::vector<std::string> RasterFile::files() const { return files_of(*dataset_); }

std::array<double, 2> RasterFile::map_of(double column, double row) const {
  const auto& g = map_from_cell_;
  const double c = column + 0.5, r = row + 0.5;
  return {g[0] + c * g[1] + r * g[2], g[3] + c * g[4] + r * g[5]};
}

std::array<double, 2> RasterFile::cell_of(double map_x, double map_y) const {
  if (turn_ > 0.0) map_x -= turn_ * std::round((map_x - map_of((columns_ - 1) / 2.0, (rows_ - 1) / 2.0)[0]) / turn_);
  const auto& g = cell_from_map_;
  return {g[0] + map_x * g[1] + map_y * g[2] - 0.5, g[3] + map_x * g[4] + map_y * g[5] - 0.5};
}

std::vector<float> RasterFile::read_all() const {
  std::vector<float> cells(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
  read({0, 0, columns_, rows_}, cells);
  return cells;
}

void RasterFile::hold(std::vector<float> elevation_m) {
  held_ = std::move(elevation_m);
  measure();
}

void RasterFile::read(const CellWindow& w, std::span<float> elevation_m) const {
  if (!held_.empty()) {
    for (int row = 0; row < w.rows; ++row) {
      const auto first = static_cast<std::ptrdiff_t>(w.row + row) * columns_ + w.column;
      std::copy_n(held_.begin() + first, w.columns, elevation_m.begin() + std::ptrdiff_t{row} * w.columns);
    }
    return;
  }
  const std::scoped_lock lock(mutex_);
  const QuietErrors quiet;
  GDALRasterBand* band = dataset_->GetRasterBand(options_.band);
  const auto get = [&](GDALRasterBand* from, void* to, GDALDataType type) {
    if (from->RasterIO(GF_Read, first_column_ + w.column, first_row_ + w.row, w.columns, w.rows, to, w.columns, w.rows,
                       type, 0, 0, nullptr) != CE_None) {
      refuse("cells from column " + std::to_string(w.column) + ", row " + std::to_string(w.row) +
             " cannot be read: " + CPLGetLastErrorMsg());
    }
  };
  get(band, elevation_m.data(), GDT_Float32);
  std::vector<std::uint8_t> known;  // where the file says so by a mask of its own
  if ((band->GetMaskFlags() & GMF_PER_DATASET) != 0) {
    known.resize(elevation_m.size());
    get(band->GetMaskBand(), known.data(), GDT_Byte);
  }
  int has_nodata = 0;
  const double own_nodata = band->GetNoDataValue(&has_nodata);
  const bool check_nodata = options_.nodata.has_value() || has_nodata != 0;
  const auto nodata = static_cast<float>(options_.nodata.value_or(own_nodata));
  const auto scale = static_cast<float>(band->GetScale() * (options_.values_are_depths ? -1.0 : 1.0));
  const auto offset = static_cast<float>(band->GetOffset() * (options_.values_are_depths ? -1.0 : 1.0));
  for (std::size_t i = 0; i < elevation_m.size(); ++i) {
    float& value = elevation_m[i];
    const bool hole = !std::isfinite(value) || (check_nodata && value == nodata) || (!known.empty() && known[i] == 0);
    value = hole ? std::numeric_limits<float>::quiet_NaN() : value * scale + offset;
  }
}

void RasterFile::measure() {
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
  if (options_.judge_values) judge(valid, above);
}

void RasterFile::judge(std::size_t valid, std::size_t above) const {
  const bool depths = options_.values_are_depths;
  const std::string range = "from " + number(lowest_m_) + " to " + number(highest_m_) + " m";
  for (const double fill : kUsualFills) {
    const double seen = depths ? -fill : fill;
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
           (depths ? "its values are elevations or land; `seabed.raster.values: elevation` reads them as such"
                   : "its values are depths or land; `seabed.raster.values: depth` reads them as depths") +
           ", land alone cannot be surveyed");
  }
}

}  // namespace ensonify::source
