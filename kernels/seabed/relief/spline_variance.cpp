#include "kernels/seabed/relief/spline_variance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace ensonify::relief {
namespace {

/// What one coefficient becomes after refinements, in one dimension.
std::vector<double> response(int refinements) {
  constexpr std::array<double, 7> kWeights{1.0, 6.0, 15.0, 20.0, 15.0, 6.0, 1.0};
  std::vector<double> now{1.0};
  for (int k = 0; k < refinements; ++k) {
    std::vector<double> next(2 * now.size() + 5, 0.0);
    for (std::size_t i = 0; i < now.size(); ++i) {
      for (std::size_t m = 0; m < kWeights.size(); ++m) next[2 * i + m] += now[i] * kWeights[m] / 32.0;
    }
    now = std::move(next);
  }
  return now;
}

/// Mean over the 2^levels places of the sum of squares, squared for two dimensions.
double mean_square(const std::vector<double>& numbers, int levels) {
  double sum = 0.0;
  for (const double x : numbers) sum += x * x;
  const double one_dimension = std::ldexp(sum, -levels);
  return one_dimension * one_dimension;
}

constexpr int kConverged = 8;  // more levels change the variance by less than 1e-5

}  // namespace

double variance_of_coefficients(int levels_down) {
  const int levels = std::min(levels_down, kConverged);
  return mean_square(response(levels), levels);
}

double variance_at_posts(int levels_down) {
  const int levels = std::min(levels_down, kConverged);
  const std::vector<double> c = response(levels);
  constexpr std::array<double, 5> kSpline{1.0 / 120.0, 26.0 / 120.0, 66.0 / 120.0, 26.0 / 120.0, 1.0 / 120.0};
  std::vector<double> z(c.size() + 4, 0.0);
  for (std::size_t i = 0; i < c.size(); ++i) {
    for (std::size_t m = 0; m < kSpline.size(); ++m) z[i + m] += c[i] * kSpline[m];
  }
  return mean_square(z, levels);
}

}  // namespace ensonify::relief
