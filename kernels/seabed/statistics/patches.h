#pragma once

#include <span>

#include "kernels/seabed/statistics/surface.h"

namespace ensonify::relief_statistics {

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
