#include "kernels/survey/grid/holes.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

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

}  // namespace ensonify::survey_grid
