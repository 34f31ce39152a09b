#include "kernels/seabed/relief/guide.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "kernels/seabed/relief/window.h"

namespace ensonify::relief {
namespace {

void check(const Raster& raster) {
  if (raster.columns < 2 || raster.rows < 2 || !(raster.cell_m > 0.0) ||
      raster.value.size() != static_cast<std::size_t>(raster.columns) * static_cast<std::size_t>(raster.rows)) {
    throw std::invalid_argument("guide: " + std::to_string(raster.value.size()) + " values for " +
                                std::to_string(raster.columns) + " x " + std::to_string(raster.rows) +
                                " cells; allowed: one value per cell, 2 x 2 cells or more, cells of positive size");
  }
  if (!std::all_of(raster.value.begin(), raster.value.end(), [](float z) { return std::isfinite(z); }))
    throw std::invalid_argument("guide: a value is not finite; fill the holes first");
}

/// Coefficients of the cubic spline through `count` numbers that are `stride` apart, mirrored at both ends: one pole,
/// sqrt(3) - 2, run forth and back [Unser1999].
void to_coefficients(float* numbers, int count, int stride) {
  const double pole = std::sqrt(3.0) - 2.0;
  constexpr int kHorizon = 24;  // pole^24 = 2e-14
  const auto at = [&](int i) -> float& { return numbers[static_cast<std::ptrdiff_t>(i) * stride]; };
  const auto mirrored = [&](int i) {
    const int period = 2 * (count - 1), k = i % period;
    return static_cast<double>(at(k < count ? k : period - k));
  };
  std::vector<double> forth(static_cast<std::size_t>(count));
  double start = 0.0, power = 1.0;
  for (int i = 0; i < kHorizon; ++i, power *= pole) start += power * mirrored(i);
  forth[0] = start;
  for (int i = 1; i < count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    forth[k] = at(i) + pole * forth[k - 1];
  }
  const auto last = static_cast<std::size_t>(count - 1);
  double back = pole / (pole * pole - 1.0) * (forth[last] + pole * forth[last - 1]);
  at(count - 1) = static_cast<float>(6.0 * back);
  for (int i = count - 2; i >= 0; --i) {
    back = pole * (back - forth[static_cast<std::size_t>(i)]);
    at(i) = static_cast<float>(6.0 * back);
  }
}

/// For each column (or row) of a window: the four coefficients that matter and their weights.
struct Taps {
  std::vector<std::array<int, 4>> index;
  std::vector<std::array<float, 4>> weight;
};

/// Indices of mirrored coefficients; places beyond the raster are held at its edge.
Taps taps_of(const std::vector<double>& place_cells, int count) {
  Taps taps;
  for (const double raw : place_cells) {
    const double place = std::clamp(raw, 0.0, static_cast<double>(count - 1));
    const int cell = std::min(static_cast<int>(place), count - 2);
    const double t = place - cell, u = 1.0 - t;
    std::array<int, 4> index{};
    for (int k = 0; k < 4; ++k) {
      const int i = std::abs(cell - 1 + k);
      index[static_cast<std::size_t>(k)] = i < count ? i : 2 * (count - 1) - i;
    }
    taps.index.push_back(index);
    taps.weight.push_back(
        {static_cast<float>(u * u * u / 6.0), static_cast<float>((4.0 - 6.0 * t * t + 3.0 * t * t * t) / 6.0),
         static_cast<float>((4.0 - 6.0 * u * u + 3.0 * u * u * u) / 6.0), static_cast<float>(t * t * t / 6.0)});
  }
  return taps;
}

/// Places of a window's columns and rows, in cells of a raster from its first value.
struct CellPlaces {
  std::vector<double> columns, rows;
};

CellPlaces cells_of(const Raster& raster, const Window& window, double post_spacing_m) {
  CellPlaces places;
  for (int i = 0; i < window.columns; ++i)
    places.columns.push_back((place_enu_m(window, i, 0, post_spacing_m).x() - raster.first_enu_m.x()) / raster.cell_m);
  for (int j = 0; j < window.rows; ++j)
    places.rows.push_back((place_enu_m(window, 0, j, post_spacing_m).y() - raster.first_enu_m.y()) / raster.cell_m);
  return places;
}

}  // namespace

Field smooth_surface(const Raster& raster, double post_spacing_m) {
  check(raster);
  Raster spline = raster;
  for (int j = 0; j < spline.rows; ++j)
    to_coefficients(spline.value.data() + static_cast<std::ptrdiff_t>(j) * spline.columns, spline.columns, 1);
  for (int i = 0; i < spline.columns; ++i) to_coefficients(spline.value.data() + i, spline.rows, spline.columns);
  return [spline = std::move(spline), post_spacing_m](const Window& window, std::span<float> out) {
    const CellPlaces places = cells_of(spline, window, post_spacing_m);
    const Taps across = taps_of(places.columns, spline.columns), up = taps_of(places.rows, spline.rows);
    int first = spline.columns, last = 0;
    for (const auto& index : across.index) {
      for (const int i : index) first = std::min(first, i), last = std::max(last, i);
    }
    std::vector<float> row(static_cast<std::size_t>(spline.columns));
    for (int j = 0; j < window.rows; ++j) {
      const auto& line = up.index[static_cast<std::size_t>(j)];
      const auto& w = up.weight[static_cast<std::size_t>(j)];
      const auto coefficient = [&](std::size_t k, int i) {
        return spline.value[static_cast<std::size_t>(line[k]) * static_cast<std::size_t>(spline.columns) +
                            static_cast<std::size_t>(i)];
      };
      for (int i = first; i <= last; ++i)
        row[static_cast<std::size_t>(i)] =
            w[0] * coefficient(0, i) + w[1] * coefficient(1, i) + w[2] * coefficient(2, i) + w[3] * coefficient(3, i);
      float* to = out.data() + window.node(0, j);
      for (std::size_t i = 0; i < across.index.size(); ++i) {
        const auto& c = across.index[i];
        const auto& v = across.weight[i];
        to[i] = v[0] * row[static_cast<std::size_t>(c[0])] + v[1] * row[static_cast<std::size_t>(c[1])] +
                v[2] * row[static_cast<std::size_t>(c[2])] + v[3] * row[static_cast<std::size_t>(c[3])];
      }
    }
  };
}

}  // namespace ensonify::relief
