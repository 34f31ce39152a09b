#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace ensonify::regression {

struct Slope {
  double value = 0.0;
  double standard_error = 0.0;
  std::size_t count = 0;
};

/// Each sample less the mean of the `2 half + 1` about it; those with fewer on a side are left out. A straight line
/// gives 0, so that what is left of places on a track is how they sway.
std::vector<double> about_running_mean(std::span<const double> samples, std::size_t half);

/// Slope of y = slope * x by least squares; both have zero mean. The standard error holds for
/// residuals whose size changes, and that are correlated over up to `lags` samples [NeweyWest1987]. Nothing for fewer
/// than three samples, or where x is 0 throughout.
std::optional<Slope> slope_through_zero(std::span<const double> x, std::span<const double> y, std::size_t lags);

}  // namespace ensonify::regression
