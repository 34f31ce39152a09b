#include "components/terrain/raster_cells.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ensonify::source {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

}  // namespace

double interpolate(const CellWindow& window, const std::vector<float>& elevation_m, double column, double row) {
  const double c = column - window.column, r = row - window.row;
  if (!(c >= 0.0 && r >= 0.0 && c <= window.columns - 1 && r <= window.rows - 1)) return kNone;
  const int i = std::min(static_cast<int>(c), window.columns - 2);
  const int j = std::min(static_cast<int>(r), window.rows - 2);
  const double u = c - i, v = r - j;
  const float* first = &elevation_m[static_cast<std::size_t>(j) * static_cast<std::size_t>(window.columns) +
                                    static_cast<std::size_t>(i)];
  const float* second = first + window.columns;
  const auto between = [](double a, double b, double t) { return t == 0.0 ? a : t == 1.0 ? b : (1.0 - t) * a + t * b; };
  return between(between(first[0], first[1], u), between(second[0], second[1], u), v);
}

double nearest(const CellWindow& window, const std::vector<float>& value, double column, double row) {
  const double c = std::round(column - window.column), r = std::round(row - window.row);
  if (!(c >= 0.0 && r >= 0.0 && c <= window.columns - 1 && r <= window.rows - 1)) return kNone;
  return value[static_cast<std::size_t>(r) * static_cast<std::size_t>(window.columns) + static_cast<std::size_t>(c)];
}

std::optional<CellWindow> window_around(const RasterFile& file, const std::vector<double>& column,
                                        const std::vector<double>& row) {
  double west = 1e300, east = -1e300, upper = 1e300, lower = -1e300;
  for (std::size_t k = 0; k < column.size(); ++k) {
    if (!std::isfinite(column[k]) || !std::isfinite(row[k])) continue;
    west = std::min(west, column[k]), east = std::max(east, column[k]);
    upper = std::min(upper, row[k]), lower = std::max(lower, row[k]);
  }
  const double last_column = file.columns() - 1, last_row = file.rows() - 1;
  if (east < 0.0 || west > last_column || lower < 0.0 || upper > last_row || west > east) return std::nullopt;
  const auto first = [](double from, double last) {
    return static_cast<int>(std::clamp(std::floor(from) - 1.0, 0.0, last - 1.0));
  };
  const auto count = [](double to, double last, int from) {
    return static_cast<int>(std::clamp(std::ceil(to) + 1.0, from + 1.0, last)) - from + 1;
  };
  const int c = first(west, last_column), r = first(upper, last_row);
  return CellWindow{c, r, count(east, last_column, c), count(lower, last_row, r)};
}

}  // namespace ensonify::source
