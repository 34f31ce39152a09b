#include "kernels/instruments/regression/slope.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace ensonify::regression {

std::vector<double> about_running_mean(std::span<const double> samples, std::size_t half) {
  std::vector<double> left;
  for (std::size_t i = half; i + half < samples.size(); ++i) {
    const auto about = samples.subspan(i - half, 2 * half + 1);
    left.push_back(samples[i] - std::accumulate(about.begin(), about.end(), 0.0) / static_cast<double>(about.size()));
  }
  return left;
}

std::optional<Slope> slope_through_zero(std::span<const double> x, std::span<const double> y, std::size_t lags) {
  const std::size_t count = std::min(x.size(), y.size());
  double xx = 0.0, xy = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    xx += x[i] * x[i];
    xy += x[i] * y[i];
  }
  if (count < 3 || !(xx > 0.0)) return std::nullopt;
  const double slope = xy / xx;

  std::vector<double> scores(count);  // x_i e_i
  for (std::size_t i = 0; i < count; ++i) scores[i] = x[i] * (y[i] - slope * x[i]);
  double sum = 0.0;
  for (std::size_t lag = 0; lag <= lags && lag < count; ++lag) {
    double products = 0.0;
    for (std::size_t i = lag; i < count; ++i) products += scores[i] * scores[i - lag];
    const double weight = 1.0 - static_cast<double>(lag) / static_cast<double>(lags + 1);  // Bartlett's
    sum += (lag == 0 ? 1.0 : 2.0) * weight * products;
  }
  return Slope{slope, std::sqrt(std::max(sum, 0.0)) / xx, count};
}

}  // namespace ensonify::regression
