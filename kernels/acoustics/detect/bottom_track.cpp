#include "kernels/acoustics/detect/bottom_track.h"

#include <algorithm>
#include <cmath>

namespace ensonify::detect {
namespace {

constexpr double kLeastPower = 1e-30;  // silence, so that its logarithm is finite
constexpr double kLonger = 1.1;        // than a single echo, which noise may lengthen by a sample

double power(const WaterfallLine& line, std::size_t k) {
  const double a = line.amplitude[k];
  return std::max(a * a, kLeastPower);
}

/// The first sample at or beyond a range.
std::size_t index_from(const WaterfallLine& line, double range_m) {
  const double k = std::ceil((range_m - line.first_range_m) / line.range_step_m);
  return static_cast<std::size_t>(std::clamp(k, 0.0, static_cast<double>(line.amplitude.size())));
}

/// How many samples are examined from a strong one on, and how many of them must be strong.
struct Run {
  std::size_t samples, strong;
};

Run run_of(const FirstBottomSettings& settings, double step_m) {
  const double single = std::ceil(settings.echo_m / step_m - 1e-6);
  const double longer = std::floor(kLonger * single / settings.share) + 1.0;
  const double samples = std::max(std::round(settings.persistence_m / step_m), longer);
  return {static_cast<std::size_t>(samples), static_cast<std::size_t>(std::ceil(settings.share * samples))};
}

}  // namespace

BottomPick first_bottom(const FirstBottomSettings& settings, const WaterfallLine& line, double nearest_m,
                        double farthest_m) {
  const std::size_t column = index_from(line, settings.blanking_m);
  const std::size_t first = index_from(line, std::max(nearest_m, settings.blanking_m + settings.column_m));
  const std::size_t end = index_from(line, farthest_m);
  const Run run = run_of(settings, line.range_step_m);
  const double threshold = std::pow(10.0, 0.1 * settings.threshold_db);

  double log_sum = 0.0;
  for (std::size_t k = column; k < end && k + run.samples <= line.amplitude.size(); ++k) {
    if (k >= first && k > column) {
      const double strong = threshold * std::exp(log_sum / static_cast<double>(k - column));
      if (power(line, k) > strong) {
        std::size_t count = 0;
        for (std::size_t i = k; i < k + run.samples; ++i) count += power(line, i) > strong;
        if (count >= run.strong) return {true, line.first_range_m + static_cast<double>(k) * line.range_step_m};
      }
    }
    log_sum += std::log(power(line, k));
  }
  return {};
}

BottomTrack follow(const FirstBottomSettings& settings, const BottomTrack& before, const WaterfallLine& line) {
  const bool near = before.tracked && before.missed <= settings.patience;
  const BottomPick pick =
      near ? first_bottom(settings, line, before.altitude_m - settings.follow_m, before.altitude_m + settings.follow_m)
           : first_bottom(settings, line);
  if (pick.found) return {true, pick.altitude_m, 0};
  return {near, before.altitude_m, before.missed + 1};
}

}  // namespace ensonify::detect
