#include "kernels/survey/grid/stripes.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

namespace ensonify::survey_grid {
namespace {

constexpr int kReach = 48;       // cells to each side whose mean is the surroundings
constexpr int kHalfLength = 64;  // cells to each side along a stripe
constexpr double kShift = 6.0;   // cells by which the middle of the surroundings may be off
constexpr double kClip = 3.0;    // standard deviations beyond which a rock or a pit does not count
constexpr int kDirections = 90;
constexpr double kPlaces = 20000;  // cells at which directions are tried
constexpr double kFoundContrast = 4.0;
constexpr double kLeast_m = 1e-3;
constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

/// Sums over all cells below and left of a corner, of what stands out of a rectangle by four of them.
class SummedArea {
 public:
  SummedArea(const Surface& surface, double (*value)(float height_m, int column, int row))
      : columns_(static_cast<std::size_t>(surface.columns) + 1),
        sum_(columns_ * (static_cast<std::size_t>(surface.rows) + 1), 0.0) {
    for (int row = 0; row < surface.rows; ++row) {
      double line = 0.0;
      for (int column = 0; column < surface.columns; ++column) {
        const float height_m = surface.at(column, row);
        if (!std::isnan(height_m)) line += value(height_m, column, row);
        sum_[at(column + 1, row + 1)] = sum_[at(column + 1, row)] + line;
      }
    }
  }
  /// Over the columns [west, east) and the rows [low, high).
  double over(int west, int east, int low, int high) const {
    return sum_[at(east, high)] - sum_[at(west, high)] - sum_[at(east, low)] + sum_[at(west, low)];
  }

 private:
  std::size_t at(int column, int row) const {
    return static_cast<std::size_t>(row) * columns_ + static_cast<std::size_t>(column);
  }
  std::size_t columns_;
  std::vector<double> sum_;
};

/// Means over what is known in rectangles of cells.
class Surroundings {
 public:
  explicit Surroundings(const Surface& surface)
      : count_(surface, [](float, int, int) { return 1.0; }),
        height_(surface, [](float height_m, int, int) { return static_cast<double>(height_m); }),
        column_(surface, [](float, int column, int) { return static_cast<double>(column); }),
        row_(surface, [](float, int, int row) { return static_cast<double>(row); }) {}

  struct Mean {
    double cells, height_m, column, row;
  };
  Mean over(int west, int east, int low, int high) const {
    const double cells = count_.over(west, east, low, high);
    return {cells, height_.over(west, east, low, high) / cells, column_.over(west, east, low, high) / cells,
            row_.over(west, east, low, high) / cells};
  }

 private:
  SummedArea count_, height_, column_, row_;
};

/// The height of the surroundings at their own middle, carried to a cell along their slope, which the means of their
/// halves give; NaN where they lie to one side.
double level_at(const Surroundings& around, int column, int row, int columns, int rows) {
  const int west = std::max(0, column - kReach), east = std::min(columns, column + kReach + 1);
  const int low = std::max(0, row - kReach), high = std::min(rows, row + kReach + 1);
  const auto all = around.over(west, east, low, high);
  const double off_east = column - all.column, off_north = row - all.row;
  if (std::hypot(off_east, off_north) > kShift || all.cells < kReach * kReach) return kNone;
  const auto left = around.over(west, column, low, high), right = around.over(column, east, low, high);
  const auto below = around.over(west, east, low, row), above = around.over(west, east, row, high);
  const double east_slope = (right.height_m - left.height_m) / (right.column - left.column);
  const double north_slope = (above.height_m - below.height_m) / (above.row - below.row);
  return all.height_m + east_slope * off_east + north_slope * off_north;
}

/// Heights less the level of their surroundings; NaN where there are none.
Surface standing_out(const Surface& surface) {
  const Surroundings around(surface);
  Surface out = surface;
  tbb::parallel_for(0, surface.rows, [&](int row) {
    for (int column = 0; column < surface.columns; ++column) {
      float& own = out.height_m[static_cast<std::size_t>(row) * static_cast<std::size_t>(surface.columns) +
                                static_cast<std::size_t>(column)];
      if (!std::isnan(own))
        own = static_cast<float>(own - level_at(around, column, row, surface.columns, surface.rows));
    }
  });
  return out;
}

/// Cuts off what is no stripe: single features that stand out far. False when nothing stands out at all.
bool clip(Surface& out) {
  double power = 0.0;
  std::int64_t count = 0;
  for (const float value : out.height_m) {
    if (std::isnan(value)) continue;
    power += static_cast<double>(value) * value;
    ++count;
  }
  if (!(power > 0.0)) return false;
  const auto most = static_cast<float>(kClip * std::sqrt(power / static_cast<double>(count)));
  for (float& value : out.height_m) value = std::clamp(value, -most, most);  // NaN stays
  return true;
}

/// The way along a stripe, every second cell of its length, from its middle.
std::vector<std::pair<int, int>> way_along(double along_rad) {
  std::vector<std::pair<int, int>> way;
  for (int step = -kHalfLength; step <= kHalfLength; step += 2) {
    way.emplace_back(static_cast<int>(std::lround(step * std::cos(along_rad))),
                     static_cast<int>(std::lround(step * std::sin(along_rad))));
  }
  return way;
}

/// The mean along a way through a cell; NaN if half of it is unknown.
double mean_along(const Surface& out, int column, int row, const std::vector<std::pair<int, int>>& way) {
  double sum = 0.0;
  std::size_t known = 0;
  for (const auto& [east, north] : way) {
    const int c = column + east, r = row + north;
    if (c < 0 || r < 0 || c >= out.columns || r >= out.rows || std::isnan(out.at(c, r))) continue;
    sum += out.at(c, r);
    ++known;
  }
  return 2 * known > way.size() ? sum / static_cast<double>(known) : std::numeric_limits<double>::quiet_NaN();
}

/// Cells, spread evenly, that have surroundings.
std::vector<std::pair<int, int>> places(const Surface& out) {
  const double cells = static_cast<double>(out.columns) * out.rows;
  const int every = std::max(1, static_cast<int>(std::sqrt(cells / kPlaces)));
  std::vector<std::pair<int, int>> list;
  for (int row = every / 2; row < out.rows; row += every) {
    for (int column = every / 2; column < out.columns; column += every) {
      if (!std::isnan(out.at(column, row))) list.emplace_back(column, row);
    }
  }
  return list;
}

/// Over the places: the mean of the means along a direction times those a distance across it.
double covariance(const Surface& out, const std::vector<std::pair<int, int>>& list, double along_rad, double across) {
  const auto way = way_along(along_rad);
  const int east = static_cast<int>(std::lround(-across * std::sin(along_rad)));
  const int north = static_cast<int>(std::lround(across * std::cos(along_rad)));
  double sum = 0.0;
  int count = 0;
  for (const auto& [column, row] : list) {
    const double here = mean_along(out, column, row, way);
    const double there = across == 0.0 ? here : mean_along(out, column + east, row + north, way);
    if (std::isnan(here) || std::isnan(there)) continue;
    sum += here * there;
    ++count;
  }
  return count > 0 ? sum / count : 0.0;
}

/// Distance across the stripes at which they repeat themselves again: the first peak of their autocovariance, the
/// highest within 8 cells, that is a third of the variance and lies behind a place where they are unlike themselves.
double spacing(const Surface& out, const std::vector<std::pair<int, int>>& list, double along_rad) {
  constexpr int kFarthest = 2 * kReach, kAside = 8;
  std::vector<double> c(kFarthest);
  tbb::parallel_for(0, kFarthest, [&](int d) { c[static_cast<std::size_t>(d)] = covariance(out, list, along_rad, d); });
  bool unlike = false;
  for (int d = 1; d + kAside < kFarthest; ++d) {
    const auto at = c.begin() + d;
    unlike |= *at < 0.0;
    if (unlike && *at > c[0] / 3.0 && *at >= *std::max_element(at - std::min(d, kAside), at + kAside + 1)) return d;
  }
  return 0.0;
}

}  // namespace

Stripes stripes_of(const Surface& surface) {
  relief_statistics::check(surface);
  Stripes stripes;
  if (surface.columns <= 2 * kReach || surface.rows <= 2 * kReach) return stripes;
  Surface out = standing_out(surface);
  const auto list = places(out);
  if (list.empty() || !clip(out)) return stripes;
  std::vector<double> variance(kDirections);
  const auto angle = [](int k) { return k * std::numbers::pi / kDirections; };
  tbb::parallel_for(0, kDirections,
                    [&](int k) { variance[static_cast<std::size_t>(k)] = covariance(out, list, angle(k), 0.0); });
  const auto most = std::max_element(variance.begin(), variance.end());
  std::vector<double> sorted = variance;
  std::nth_element(sorted.begin(), sorted.begin() + kDirections / 2, sorted.end());
  const double usual = sorted[kDirections / 2];
  stripes.along_rad = angle(static_cast<int>(most - variance.begin()));
  stripes.contrast = usual > 0.0 ? *most / usual : 0.0;
  stripes.sd_m = std::sqrt(std::max(0.0, *most - usual));
  stripes.found = stripes.contrast > kFoundContrast && stripes.sd_m > kLeast_m;
  if (stripes.found) stripes.spacing_spacings = spacing(out, list, stripes.along_rad);
  return stripes;
}

std::int64_t remove_stripes(Surface& surface, const Stripes& stripes) {
  Surface out = standing_out(surface);
  if (!clip(out)) return 0;
  const auto way = way_along(stripes.along_rad);
  std::vector<std::int64_t> changed(static_cast<std::size_t>(surface.rows), 0);
  tbb::parallel_for(0, surface.rows, [&](int row) {
    for (int column = 0; column < surface.columns; ++column) {
      const double stripe_m = mean_along(out, column, row, way);
      float& own = surface.height_m[static_cast<std::size_t>(row) * static_cast<std::size_t>(surface.columns) +
                                    static_cast<std::size_t>(column)];
      if (std::isnan(own) || std::isnan(stripe_m)) continue;
      own = static_cast<float>(own - stripe_m);
      ++changed[static_cast<std::size_t>(row)];
    }
  });
  return std::accumulate(changed.begin(), changed.end(), std::int64_t{0});
}

}  // namespace ensonify::survey_grid
