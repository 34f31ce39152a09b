#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace ensonify::relief_statistics {

/// Heights on a square lattice of posts, row by row from the south, each row from the west. NaN is a hole.
struct Surface {
  int columns = 0;
  int rows = 0;
  double spacing_m = 1.0;
  std::vector<float> height_m;

  float at(int column, int row) const {
    return height_m[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                    static_cast<std::size_t>(column)];
  }
};

/// A square part of a surface and the plane that fits it best (least squares).
struct Patch {
  std::vector<double> residual_m;  // height less the plane, row by row
  double east_slope = 0.0;         // of the plane, m per m
  double north_slope = 0.0;
  double mean_m = 0.0;
};

/// Throws std::invalid_argument unless the sizes agree and there is at least one post.
void check(const Surface& surface);

/// The `cells` x `cells` posts from (column, row) on, less their plane. False, and `patch` in an unspecified state, if
/// one of them is a hole.
bool patch_of(const Surface& surface, int column, int row, int cells, Patch& patch);

struct Line {
  double slope = 0.0;
  double at_zero = 0.0;
};

/// Least squares through at least two places of different x.
inline Line fit_line(std::span<const double> x, std::span<const double> y) {
  const auto n = static_cast<double>(x.size());
  double mean_x = 0.0, mean_y = 0.0, xx = 0.0, xy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    mean_x += x[i] / n;
    mean_y += y[i] / n;
  }
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - mean_x) * (x[i] - mean_x);
    xy += (x[i] - mean_x) * (y[i] - mean_y);
  }
  const double slope = xy / xx;
  return {slope, mean_y - slope * mean_x};
}

/// Patchiness of roughness: statistics of the rms about the best plane in patches of
/// `patch_cells` x `patch_cells` posts, side by side; patches with holes are left out.
struct Patchiness {
  int patches = 0;
  double rms_over_median = 0.0;    // root mean square over median of the patches' rms: 1.04 for fractional Brownian
  double p95_over_p5 = 0.0;        // of the patches' rms
  double bimodality = 0.0;         // Sarle's, of ln rms: above 0.555 (a uniform law's) two classes are seen
  double slope_correlation = 0.0;  // Spearman's, of rms and slope of the plane
  double slope_p50_deg = 0.0;      // of the planes
  double slope_p95_deg = 0.0;
};

/// Level patches (rms 0) count as the smallest rms that is not 0. All zeros if there are fewer than ten patches or
/// the whole surface is level. Throws std::invalid_argument for patches below 3 posts.
Patchiness patchiness(const Surface& surface, int patch_cells = 9);

/// Sarle's bimodality coefficient (skewness^2 + 1) / (kurtosis + 3 (n-1)^2 / ((n-2)(n-3))) with sample-size corrected
/// moments [Pfister2013]: 1/3 for a Gaussian, 0.555 for a uniform law, 1 for two equal peaks. NaN below 4 numbers.
double bimodality(std::span<const double> numbers);

/// Spearman's rank correlation; equal numbers share their mean rank. NaN if one side does not vary.
double rank_correlation(std::span<const double> a, std::span<const double> b);

/// The number below which the fraction `p` of them lies, linear between ranks. `sorted` is rising and not empty.
double percentile(std::span<const double> sorted, double p);

}  // namespace ensonify::relief_statistics
