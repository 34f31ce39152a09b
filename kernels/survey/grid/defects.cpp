#include "kernels/survey/grid/defects.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <stdexcept>

#include "kernels/seabed/statistics/power_spectrum.h"

namespace ensonify::survey_grid {
namespace {

constexpr std::int32_t kKnown = -1, kUnseen = -2;

/// Squares of the distances to the nearest known post, in spacings: along columns first, then the least over each row
/// of (column - other)^2 + along^2 by the lower envelope of those parabolas [Felzenszwalb2012].
std::vector<float> squared_distances(const Surface& surface, const std::vector<std::int32_t>& label) {
  const int columns = surface.columns, rows = surface.rows;
  const auto at = [columns](int column, int row) {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column);
  };
  const float far = static_cast<float>(columns) + static_cast<float>(rows);
  std::vector<float> squared(label.size());
  tbb::parallel_for(0, columns, [&](int column) {
    float away = far;
    for (int row = 0; row < rows; ++row) {
      away = label[at(column, row)] == kKnown ? 0.0F : std::min(far, away + 1.0F);
      squared[at(column, row)] = away;
    }
    for (int row = rows - 1; row >= 0; --row) {
      away = label[at(column, row)] == kKnown ? 0.0F : std::min(far, away + 1.0F);
      float& here = squared[at(column, row)];
      here = std::min(here, away);
      here *= here;
    }
  });
  tbb::parallel_for(0, rows, [&](int row) {
    const auto height = [&](int column) { return static_cast<double>(squared[at(column, row)]); };
    std::vector<int> lowest{0};        // columns whose parabolas make the envelope
    std::vector<double> from{-1e300};  // where each begins to be the lowest
    for (int q = 1; q < columns; ++q) {
      const auto crosses_at = [&](int p) {
        return (height(q) - height(p) + static_cast<double>(q) * q - static_cast<double>(p) * p) / (2.0 * (q - p));
      };
      double begins = crosses_at(lowest.back());
      while (begins <= from.back()) {
        lowest.pop_back(), from.pop_back();
        begins = crosses_at(lowest.back());
      }
      lowest.push_back(q), from.push_back(begins);
    }
    std::vector<float> line(static_cast<std::size_t>(columns));
    std::size_t k = 0;
    for (int column = 0; column < columns; ++column) {
      while (k + 1 < lowest.size() && from[k + 1] < column) ++k;
      const double away = column - lowest[k];
      line[static_cast<std::size_t>(column)] = static_cast<float>(away * away + height(lowest[k]));
    }
    std::copy(line.begin(), line.end(), squared.begin() + static_cast<std::ptrdiff_t>(at(0, row)));
  });
  return squared;
}

/// Gives a number to all posts of the hole that holds a post.
Hole label_hole(const Surface& surface, int column, int row, std::int32_t number, std::vector<std::int32_t>& label) {
  Hole hole{.column = column, .row = row};
  std::vector<std::array<int, 2>> left{{column, row}};
  const auto take = [&](int c, int r) {
    if (c < 0 || r < 0 || c >= surface.columns || r >= surface.rows) return;
    auto& seen =
        label[static_cast<std::size_t>(r) * static_cast<std::size_t>(surface.columns) + static_cast<std::size_t>(c)];
    if (seen != kUnseen) return;
    seen = number;
    left.push_back({c, r});
  };
  left.clear();
  take(column, row);
  while (!left.empty()) {
    const auto [c, r] = left.back();
    left.pop_back();
    ++hole.posts;
    hole.at_rim |= c == 0 || r == 0 || c == surface.columns - 1 || r == surface.rows - 1;
    take(c - 1, r), take(c + 1, r), take(c, r - 1), take(c, r + 1);
  }
  return hole;
}

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

constexpr int kWindow = 64;
constexpr double kSteepest = 4.1;  // between what seabeds and what grids do

/// Weighted sums along one line of values, `step` apart; the weights are those of a Gaussian, from its middle outwards.
void smear(const std::vector<double>& weight, const std::vector<double>& from, std::vector<double>& to,
           std::size_t first, std::size_t step, int count) {
  const int reach = static_cast<int>(weight.size()) - 1;
  for (int i = 0; i < count; ++i) {
    double sum = 0.0;
    for (int k = std::max(-reach, -i); k <= std::min(reach, count - 1 - i); ++k)
      sum += weight[static_cast<std::size_t>(std::abs(k))] * from[first + static_cast<std::size_t>(i + k) * step];
    to[first + static_cast<std::size_t>(i) * step] = sum;
  }
}

/// Weighted sums over both directions.
void smear(const Surface& surface, const std::vector<double>& weight, std::vector<double>& values) {
  const auto columns = static_cast<std::size_t>(surface.columns);
  std::vector<double> along(values.size());
  tbb::parallel_for(0, surface.rows, [&](int row) {
    smear(weight, values, along, static_cast<std::size_t>(row) * columns, 1, surface.columns);
  });
  tbb::parallel_for(0, surface.columns, [&](int column) {
    smear(weight, along, values, static_cast<std::size_t>(column), columns, surface.rows);
  });
}

}  // namespace

Holes holes_of(const Surface& surface) {
  relief_statistics::check(surface);
  Holes holes;
  holes.of_post.resize(surface.height_m.size());
  for (std::size_t i = 0; i < holes.of_post.size(); ++i)
    holes.of_post[i] = std::isnan(surface.height_m[i]) ? kUnseen : kKnown;
  if (std::find(holes.of_post.begin(), holes.of_post.end(), kKnown) == holes.of_post.end())
    throw std::invalid_argument("the surface has no height at all; one post is needed");
  const std::vector<float> squared = squared_distances(surface, holes.of_post);
  std::size_t i = 0;
  for (int row = 0; row < surface.rows; ++row) {
    for (int column = 0; column < surface.columns; ++column, ++i) {
      if (holes.of_post[i] != kUnseen) continue;
      const auto number = static_cast<std::int32_t>(holes.hole.size());
      holes.hole.push_back(label_hole(surface, column, row, number, holes.of_post));
    }
  }
  for (std::size_t post = 0; post < squared.size(); ++post) {
    if (holes.of_post[post] == kKnown) continue;
    double& reach = holes.hole[static_cast<std::size_t>(holes.of_post[post])].reach_spacings;
    reach = std::max(reach, std::sqrt(static_cast<double>(squared[post])));
  }
  return holes;
}

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

Band band_of(const Surface& surface) {
  relief_statistics::check(surface);
  Band band;
  const auto spectrum = relief_statistics::radial_spectrum(surface, kWindow);
  if (spectrum.density_m4.empty() ||
      std::all_of(spectrum.density_m4.begin(), spectrum.density_m4.end(), [](double w) { return !(w > 0.0); }))
    return band;
  const double wave_number_radpm = 2.0 * std::numbers::pi / surface.spacing_m;  // of a wave of one cell
  for (double cells = 2.0; cells < 0.5 * kWindow; cells *= 2.0) {
    const auto law =
        relief_statistics::fit_power_law(spectrum, wave_number_radpm / (2.0 * cells), wave_number_radpm / cells);
    band.octaves.push_back({cells, 2.0 * cells, law.exponent});
  }
  for (const Octave& octave : band.octaves) {
    if (octave.exponent < kSteepest) break;
    band.begins_cells = octave.to_cells;
  }
  return band;
}

void remove_shorter_waves(Surface& surface, double cells) {
  relief_statistics::check(surface);
  if (!(cells >= 2.0)) throw std::invalid_argument("waves shorter than 2 cells are not on a grid; allowed: 2 or more");
  // exp(-(2 pi sigma / L)^2) of the power passes at wave length L: one half at L = cells.
  const double sigma = cells * std::sqrt(std::numbers::ln2) / (2.0 * std::numbers::pi);
  std::vector<double> weight;
  for (int k = 0; k <= static_cast<int>(std::ceil(4.0 * sigma)); ++k)
    weight.push_back(std::exp(-0.5 * k * k / (sigma * sigma)));
  std::vector<double> height(surface.height_m.size()), known(height.size());
  for (std::size_t i = 0; i < height.size(); ++i) {
    known[i] = std::isnan(surface.height_m[i]) ? 0.0 : 1.0;
    height[i] = known[i] > 0.0 ? static_cast<double>(surface.height_m[i]) : 0.0;
  }
  smear(surface, weight, height);
  smear(surface, weight, known);
  for (std::size_t i = 0; i < height.size(); ++i) {
    if (!std::isnan(surface.height_m[i])) surface.height_m[i] = static_cast<float>(height[i] / known[i]);
  }
}

}  // namespace ensonify::survey_grid
