#include "kernels/acoustics/echo/spreading.h"

#include <cmath>

namespace ensonify::echo {
namespace {

double phi(double z) {
  const double x = 2.0 * z / Spreading::kWidth;
  return std::abs(x) < 1.0 ? std::exp(2.30 * Spreading::kWidth * (std::sqrt(1.0 - x * x) - 1.0)) : 0.0;
}

}  // namespace

Spreading::Spreading() {
  for (int step = 0; step <= kSteps + 1; ++step) {  // one more, so that an offset of 1 has a next entry
    Taps taps;
    constexpr int kBefore = kWidth / 2 - 1;
    for (int i = 0; i < kWidth; ++i) {
      taps[2 * i] = taps[2 * i + 1] = static_cast<float>(phi(i - kBefore - static_cast<double>(step) / kSteps));
    }
    table_.push_back(taps);
  }
}

double Spreading::transform(double phase) {
  // Midpoints; phi rises from its edges without a bound on its slope, hence the many points: error 1e-9.
  constexpr int kPoints = 20000;
  constexpr double kStep = static_cast<double>(kWidth) / kPoints;
  const auto place = [](int i) { return -0.5 * kWidth + (i + 0.5) * kStep; };
  static const std::vector<double> window = [&] {
    std::vector<double> values;
    for (int i = 0; i < kPoints; ++i) values.push_back(phi(place(i)));
    return values;
  }();
  double sum = 0.0;
  for (int i = 0; i < kPoints; ++i) sum += window[static_cast<std::size_t>(i)] * std::cos(phase * place(i));
  return sum * kStep;
}

}  // namespace ensonify::echo
