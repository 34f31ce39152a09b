#include "kernels/seabed/statistics/surface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <string>

namespace ensonify::relief_statistics {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

double mean_of(std::span<const double> numbers) {
  return std::accumulate(numbers.begin(), numbers.end(), 0.0) / static_cast<double>(numbers.size());
}

std::vector<double> ranks_of(std::span<const double> numbers) {
  std::vector<std::size_t> order(numbers.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return numbers[i] < numbers[j]; });
  std::vector<double> rank(numbers.size());
  for (std::size_t first = 0; first < order.size();) {
    std::size_t end = first;
    while (end < order.size() && numbers[order[end]] == numbers[order[first]]) ++end;
    for (std::size_t i = first; i < end; ++i) rank[order[i]] = 0.5 * static_cast<double>(first + end - 1);
    first = end;
  }
  return rank;
}

std::vector<double> sorted(std::vector<double> numbers) {
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

}  // namespace

void check(const Surface& surface) {
  if (surface.columns < 1 || surface.rows < 1 || !(surface.spacing_m > 0.0) ||
      surface.height_m.size() != static_cast<std::size_t>(surface.columns) * static_cast<std::size_t>(surface.rows)) {
    throw std::invalid_argument("surface: " + std::to_string(surface.height_m.size()) + " heights for " +
                                std::to_string(surface.columns) + " x " + std::to_string(surface.rows) +
                                " posts; allowed: one height per post, at least one post, a positive spacing");
  }
}

bool patch_of(const Surface& surface, int column, int row, int cells, Patch& patch) {
  patch.residual_m.clear();
  const double centre = 0.5 * (cells - 1);
  double sum = 0.0, sum_x = 0.0, sum_y = 0.0, sum_xx = 0.0;
  for (int j = 0; j < cells; ++j) {
    for (int i = 0; i < cells; ++i) {
      const double z = surface.at(column + i, row + j);
      if (std::isnan(z)) return false;
      patch.residual_m.push_back(z);
      sum += z;
      sum_x += z * (i - centre);
      sum_y += z * (j - centre);
      sum_xx += (i - centre) * (i - centre);
    }
  }
  patch.mean_m = sum / (static_cast<double>(cells) * cells);
  const double per_cell_x = sum_xx > 0.0 ? sum_x / sum_xx : 0.0, per_cell_y = sum_xx > 0.0 ? sum_y / sum_xx : 0.0;
  std::size_t post = 0;
  for (int j = 0; j < cells; ++j) {
    for (int i = 0; i < cells; ++i)
      patch.residual_m[post++] -= patch.mean_m + per_cell_x * (i - centre) + per_cell_y * (j - centre);
  }
  patch.east_slope = per_cell_x / surface.spacing_m;
  patch.north_slope = per_cell_y / surface.spacing_m;
  return true;
}

double percentile(std::span<const double> sorted_numbers, double p) {
  const double place = p * static_cast<double>(sorted_numbers.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, sorted_numbers.size() - 1);
  return std::lerp(sorted_numbers[below], sorted_numbers[above], place - static_cast<double>(below));
}

double bimodality(std::span<const double> numbers) {
  if (numbers.size() < 4) return kNaN;
  const auto n = static_cast<double>(numbers.size());
  const double mean = mean_of(numbers);
  double m2 = 0.0, m3 = 0.0, m4 = 0.0;
  for (const double x : numbers) {
    const double d = x - mean;
    m2 += d * d / n;
    m3 += d * d * d / n;
    m4 += d * d * d * d / n;
  }
  const double skewness = std::sqrt(n * (n - 1.0)) / (n - 2.0) * m3 / std::pow(m2, 1.5);
  const double excess = (n - 1.0) / ((n - 2.0) * (n - 3.0)) * ((n + 1.0) * (m4 / (m2 * m2) - 3.0) + 6.0);
  return (skewness * skewness + 1.0) / (excess + 3.0 * (n - 1.0) * (n - 1.0) / ((n - 2.0) * (n - 3.0)));
}

double rank_correlation(std::span<const double> a, std::span<const double> b) {
  const std::vector<double> ra = ranks_of(a), rb = ranks_of(b);
  const double mean = 0.5 * (static_cast<double>(a.size()) - 1.0);
  double aa = 0.0, bb = 0.0, ab = 0.0;
  for (std::size_t i = 0; i < ra.size(); ++i) {
    aa += (ra[i] - mean) * (ra[i] - mean);
    bb += (rb[i] - mean) * (rb[i] - mean);
    ab += (ra[i] - mean) * (rb[i] - mean);
  }
  return aa > 0.0 && bb > 0.0 ? ab / std::sqrt(aa * bb) : kNaN;
}

Patchiness patchiness(const Surface& surface, int patch_cells) {
  check(surface);
  if (patch_cells < 3)
    throw std::invalid_argument("patch_cells is " + std::to_string(patch_cells) + ", allowed: 3 or more");
  std::vector<double> rms_m, slope_deg;
  double smallest_m = 0.0, squares = 0.0;
  Patch patch;
  for (int row = 0; row + patch_cells <= surface.rows; row += patch_cells) {
    for (int column = 0; column + patch_cells <= surface.columns; column += patch_cells) {
      if (!patch_of(surface, column, row, patch_cells, patch)) continue;
      double square = 0.0;
      for (const double z : patch.residual_m) square += z * z;
      square /= static_cast<double>(patch.residual_m.size());
      squares += square;
      rms_m.push_back(std::sqrt(square));
      slope_deg.push_back(std::atan(std::hypot(patch.east_slope, patch.north_slope)) * 180.0 / std::numbers::pi);
      if (square > 0.0 && (smallest_m == 0.0 || rms_m.back() < smallest_m)) smallest_m = rms_m.back();
    }
  }
  if (rms_m.size() < 10 || smallest_m == 0.0) return {};
  std::vector<double> log_rms;
  for (double& rms : rms_m) {
    rms = std::max(rms, smallest_m);
    log_rms.push_back(std::log(rms));
  }
  const std::vector<double> by_rms = sorted(rms_m), by_slope = sorted(slope_deg);
  Patchiness result;
  result.patches = static_cast<int>(rms_m.size());
  result.rms_over_median = std::sqrt(squares / static_cast<double>(rms_m.size())) / percentile(by_rms, 0.5);
  result.p95_over_p5 = percentile(by_rms, 0.95) / percentile(by_rms, 0.05);
  result.bimodality = bimodality(log_rms);
  result.slope_correlation = rank_correlation(rms_m, slope_deg);
  result.slope_p50_deg = percentile(by_slope, 0.5);
  result.slope_p95_deg = percentile(by_slope, 0.95);
  return result;
}

}  // namespace ensonify::relief_statistics
