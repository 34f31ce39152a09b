#include "kernels/survey/grid/spikes.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

namespace ensonify::survey_grid {
namespace {

constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
constexpr int kAround = 7;  // cells to each side over which the scatter is taken
constexpr std::size_t kFewestNeighbours = 5;
constexpr std::size_t kFewest = 20;        // differences that give a scatter
constexpr double kSigmaOfMedian = 1.4826;  // standard deviation over median magnitude, for a Gaussian

float median(std::span<float> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return 0.5F * (*middle + *std::max_element(values.begin(), middle));
}

/// The heights next to a cell.
struct Neighbours {
  std::array<float, 8> height{};
  std::size_t count = 0;

  Neighbours(const Surface& surface, int column, int row) {
    for (int r = std::max(0, row - 1); r <= std::min(surface.rows - 1, row + 1); ++r) {
      for (int c = std::max(0, column - 1); c <= std::min(surface.columns - 1, column + 1); ++c) {
        if ((c != column || r != row) && !std::isnan(surface.at(c, r))) height[count++] = surface.at(c, r);
      }
    }
  }
  std::span<float> all() { return std::span(height).first(count); }
};

/// Height less the median of the neighbours; NaN for a hole or with too few neighbours.
float difference(const Surface& surface, int column, int row) {
  const float own = surface.at(column, row);
  if (std::isnan(own)) return kNone;
  Neighbours near(surface, column, row);
  return near.count < kFewestNeighbours ? kNone : own - median(near.all());
}

/// By how much a cell is above its highest neighbour, or (negative) below its lowest; else 0.
double excess(const Surface& surface, int column, int row) {
  Neighbours near(surface, column, row);
  const auto [lowest, highest] = std::minmax_element(near.all().begin(), near.all().end());
  const double own = surface.at(column, row);
  return std::max(0.0, own - *highest) + std::min(0.0, own - *lowest);
}

/// Of the differences around a cell, its own and its neighbours' (which it moves) left out; infinite if there are few.
double scatter(const Surface& differences, int column, int row) {
  std::vector<float> around;
  for (int r = std::max(0, row - kAround); r <= std::min(differences.rows - 1, row + kAround); ++r) {
    for (int c = std::max(0, column - kAround); c <= std::min(differences.columns - 1, column + kAround); ++c) {
      const bool near = std::abs(c - column) <= 1 && std::abs(r - row) <= 1;
      if (!near && !std::isnan(differences.at(c, r))) around.push_back(std::abs(differences.at(c, r)));
    }
  }
  return around.size() < kFewest ? std::numeric_limits<double>::infinity() : kSigmaOfMedian * median(around);
}

}  // namespace

std::vector<Spike> spikes_of(const Surface& surface, double least_m, double scatters) {
  relief_statistics::check(surface);
  Surface differences{surface.columns, surface.rows, surface.spacing_m, std::vector<float>(surface.height_m.size())};
  std::vector<std::vector<Spike>> of_row(static_cast<std::size_t>(surface.rows));
  tbb::parallel_for(0, surface.rows, [&](int row) {
    for (int column = 0; column < surface.columns; ++column) {
      differences.height_m[static_cast<std::size_t>(row) * static_cast<std::size_t>(surface.columns) +
                           static_cast<std::size_t>(column)] = difference(surface, column, row);
    }
  });
  tbb::parallel_for(0, surface.rows, [&](int row) {
    for (int column = 0; column < surface.columns; ++column) {
      if (std::isnan(differences.at(column, row))) continue;
      const double above_m = excess(surface, column, row);
      if (std::abs(above_m) <= least_m || std::abs(above_m) <= scatters * scatter(differences, column, row)) continue;
      of_row[static_cast<std::size_t>(row)].push_back({column, row, above_m});
    }
  });
  std::vector<Spike> spikes;
  for (const auto& row : of_row) spikes.insert(spikes.end(), row.begin(), row.end());
  return spikes;
}

}  // namespace ensonify::survey_grid
