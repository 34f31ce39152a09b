#include "components/terrain/raster_source.h"

#include <cpl_error.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <vector>

#include "components/terrain/raster_cells.h"

namespace ensonify::source {
namespace {

constexpr int kNodeEvery = 16;        // posts between exact transformations; divides a tile's cells
constexpr double kLargest_m = 200e3;  // beyond it the flat world stretches by more than 1e-4
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

void destroy(OGRCoordinateTransformation* transformation) { OCTDestroyCoordinateTransformation(transformation); }

OGRSpatialReference geodetic() {
  OGRSpatialReference reference;
  reference.SetWellKnownGeogCS("WGS84");
  reference.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  return reference;
}

/// The world's map (frames::LocalProjection) as PROJ knows it.
OGRSpatialReference enu_at(const frames::Geodetic& origin) {
  OGRSpatialReference reference;
  reference.SetProjCS("Ensonify world");
  reference.SetWellKnownGeogCS("WGS84");
  reference.SetTM(origin.latitude_deg, origin.longitude_deg, 1.0, 0.0, 0.0);
  reference.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  return reference;
}

std::string kilometres(double east_m, double north_m) {
  char text[64];
  std::snprintf(text, sizeof text, "%.0f km x %.0f km", east_m / 1e3, north_m / 1e3);
  return text;
}

}  // namespace

/// Where posts lie among the raster's cells (fractions of columns and rows), at every 16th post.
struct RasterSource::CellGrid {
  std::int64_t first_east, first_north;  // post of the first node, a multiple of kNodeEvery
  int columns, rows;                     // nodes
  std::vector<double> column, row;       // per node

  /// Value at a post, bilinear between nodes; exactly the nodes' own along their rows and columns.
  double at(const std::vector<double>& values, std::int64_t east, std::int64_t north) const {
    const std::int64_t i = std::min<std::int64_t>((east - first_east) / kNodeEvery, columns - 2);
    const std::int64_t j = std::min<std::int64_t>((north - first_north) / kNodeEvery, rows - 2);
    const double u = static_cast<double>(east - first_east - i * kNodeEvery) / kNodeEvery;
    const double v = static_cast<double>(north - first_north - j * kNodeEvery) / kNodeEvery;
    const double* south = &values[static_cast<std::size_t>(j * columns + i)];
    const double* upper = south + columns;
    const double low = (1.0 - u) * south[0] + u * south[1];
    const double high = (1.0 - u) * upper[0] + u * upper[1];
    return (1.0 - v) * low + v * high;
  }
};

RasterSource::RasterSource(RasterOptions options, std::optional<frames::Geodetic> origin, std::uint8_t sediment)
    : RasterSource(std::make_shared<const RasterFile>(std::move(options)), origin, Between::kBilinear, sediment) {}

RasterSource::RasterSource(std::shared_ptr<const RasterFile> file, std::optional<frames::Geodetic> origin,
                           Between between, std::uint8_t sediment)
    : file_(std::move(file)),
      between_(between),
      sediment_(sediment),
      map_from_enu_(nullptr, destroy),
      enu_from_map_(nullptr, destroy) {
  CPLPushErrorHandler(CPLQuietErrorHandler);
  struct Pop {
    ~Pop() { CPLPopErrorHandler(); }
  } const pop;
  origin_ = origin ? *origin : centre();
  connect_maps();
  measure();
}

RasterSource::~RasterSource() = default;

frames::Geodetic RasterSource::centre() const {
  const OGRSpatialReference to = geodetic();
  const Transformation geodetic_from_map(OGRCreateCoordinateTransformation(&file_->reference(), &to), destroy);
  auto [x, y] = file_->map_of((file_->columns() - 1) / 2.0, (file_->rows() - 1) / 2.0);
  if (!geodetic_from_map || !geodetic_from_map->Transform(1, &x, &y)) {
    file_->refuse(std::string("its reference system cannot be related to WGS 84: ") + CPLGetLastErrorMsg());
  }
  return {y, std::remainder(x, 360.0)};
}

void RasterSource::connect_maps() {
  const OGRSpatialReference enu = enu_at(origin_);
  map_from_enu_.reset(OGRCreateCoordinateTransformation(&enu, &file_->reference()));
  enu_from_map_.reset(OGRCreateCoordinateTransformation(&file_->reference(), &enu));
  if (!map_from_enu_ || !enu_from_map_) {
    file_->refuse(std::string("its reference system cannot be related to WGS 84: ") + CPLGetLastErrorMsg());
  }
}

/// Extent and cell size in the world, along the raster's rim.
void RasterSource::measure() {
  constexpr int kSteps = 32;
  std::vector<double> x, y;
  const auto add = [&](double column, double row) {
    const auto [map_x, map_y] = file_->map_of(column, row);
    x.push_back(map_x), y.push_back(map_y);
  };
  for (int k = 0; k <= kSteps; ++k) {
    const double column = (file_->columns() - 1) * static_cast<double>(k) / kSteps;
    const double row = (file_->rows() - 1) * static_cast<double>(k) / kSteps;
    for (const double r : {0.0, file_->rows() - 1.0}) add(column, r);
    for (const double c : {0.0, file_->columns() - 1.0}) add(c, row);
  }
  const auto count = static_cast<int>(x.size());
  const bool related = enu_from_map_->Transform(count, x.data(), y.data()) != 0 &&
                       std::all_of(x.begin(), x.end(), [](double v) { return std::isfinite(v); });
  if (!related) file_->refuse("does not lie within reach of the world's origin; at most 200 km x 200 km are allowed");
  const auto [west, east] = std::minmax_element(x.begin(), x.end());
  const auto [south, north] = std::minmax_element(y.begin(), y.end());
  extent_ = {*west, *south, *east, *north};
  const double width = extent_.east_m - extent_.west_m, height = extent_.north_m - extent_.south_m;
  if (width > kLargest_m || height > kLargest_m) {
    file_->refuse("covers " + kilometres(width, height) +
                  "; at most 200 km x 200 km are allowed: cut out the survey area " + file_->options().cutting);
  }
  const double far = std::max(
      {std::abs(extent_.west_m), std::abs(extent_.east_m), std::abs(extent_.south_m), std::abs(extent_.north_m)});
  if (far > 2 * kLargest_m) {
    file_->refuse("lies " + std::to_string(static_cast<int>(far / 1e3)) +
                  " km from the scenario's origin; allowed are 400 km, or `origin: raster` in the scenario's site");
  }
  // A cell in the middle, from its centre to those of its neighbours east and south.
  const int column = (file_->columns() - 1) / 2, row = (file_->rows() - 1) / 2;
  x.clear(), y.clear();
  add(column, row), add(column + 1, row), add(column, row + 1);
  enu_from_map_->Transform(3, x.data(), y.data());
  native_spacing_m_ = std::min(std::hypot(x[1] - x[0], y[1] - y[0]), std::hypot(x[2] - x[0], y[2] - y[0]));
  cell_area_m2_ = std::abs((x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]));
}

RasterSource::Transformation RasterSource::clone(const Transformation& transformation) const {
  const std::scoped_lock lock(mutex_);
  return {transformation->Clone(), destroy};
}

RasterSource::CellGrid RasterSource::cells_of(const PostBlock& posts) const {
  const auto floor_node = [](std::int64_t post) {
    const std::int64_t remainder = ((post % kNodeEvery) + kNodeEvery) % kNodeEvery;
    return post - remainder;
  };
  CellGrid cells;
  cells.first_east = floor_node(posts.first_east);
  cells.first_north = floor_node(posts.first_north);
  const auto nodes = [&](std::int64_t first, std::int64_t last) {
    return static_cast<int>((last - first + kNodeEvery - 1) / kNodeEvery) + 1;
  };
  cells.columns = std::max(2, nodes(cells.first_east, posts.first_east + posts.columns - 1));
  cells.rows = std::max(2, nodes(cells.first_north, posts.first_north + posts.rows - 1));
  for (int j = 0; j < cells.rows; ++j) {
    for (int i = 0; i < cells.columns; ++i) {
      cells.column.push_back(static_cast<double>(cells.first_east + i * kNodeEvery) * posts.spacing_m);
      cells.row.push_back(static_cast<double>(cells.first_north + j * kNodeEvery) * posts.spacing_m);
    }
  }
  const Transformation map_from_enu = clone(map_from_enu_);
  map_from_enu->Transform(static_cast<int>(cells.column.size()), cells.column.data(), cells.row.data());
  for (std::size_t k = 0; k < cells.column.size(); ++k) {
    const auto [column, row] = file_->cell_of(cells.column[k], cells.row[k]);
    cells.column[k] = column, cells.row[k] = row;
  }
  return cells;
}

void RasterSource::sample(const PostBlock& posts, std::span<float> height_m, std::span<std::uint8_t> sediment) const {
  std::fill(height_m.begin(), height_m.end(), std::numeric_limits<float>::quiet_NaN());
  std::fill(sediment.begin(), sediment.end(), sediment_);
  const CellGrid cells = cells_of(posts);
  const auto window = window_around(*file_, cells.column, cells.row);
  if (!window) return;
  std::vector<float> elevation_m(static_cast<std::size_t>(window->columns) * static_cast<std::size_t>(window->rows));
  file_->read(*window, elevation_m);
  const auto value_at = between_ == Between::kNearest ? nearest : interpolate;
  std::size_t k = 0;
  for (int j = 0; j < posts.rows; ++j) {
    for (int i = 0; i < posts.columns; ++i, ++k) {
      const std::int64_t east = posts.first_east + i, north = posts.first_north + j;
      height_m[k] = static_cast<float>(
          value_at(*window, elevation_m, cells.at(cells.column, east, north), cells.at(cells.row, east, north)));
    }
  }
}

Vec2 RasterSource::place_of(int column, int row) const {
  const std::scoped_lock lock(mutex_);
  auto [x, y] = file_->map_of(column, row);
  if (!enu_from_map_->Transform(1, &x, &y)) return {kNone, kNone};
  return {x, y};
}

double RasterSource::height_m(const Vec2& place) const {
  const std::scoped_lock lock(mutex_);
  double x = place.x(), y = place.y();
  if (!map_from_enu_->Transform(1, &x, &y)) return kNone;
  const auto cell = file_->cell_of(x, y);
  const std::vector<double> column{cell[0]}, row{cell[1]};
  const auto window = window_around(*file_, column, row);
  if (!window) return kNone;
  std::vector<float> elevation_m(static_cast<std::size_t>(window->columns) * static_cast<std::size_t>(window->rows));
  file_->read(*window, elevation_m);
  return (between_ == Between::kNearest ? nearest : interpolate)(*window, elevation_m, column[0], row[0]);
}

}  // namespace ensonify::source
