#include "kernels/acoustics/array/shading.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

namespace ensonify::array {
namespace {

constexpr double kPi = std::numbers::pi;

/// T_order(x), the Chebyshev polynomial, for x >= 0.
double chebyshev(int order, double x) {
  return x <= 1.0 ? std::cos(order * std::acos(x)) : std::cosh(order * std::acosh(x));
}

/// Weight at m elements from the centre: the discrete Fourier transform of the pattern T_{N-1}(x0 cos(psi / 2)), where
/// T_{N-1}(x0) is the main lobe over the side lobes [Dolph1946].
std::vector<double> dolph_chebyshev(double ratio, int N) {
  if (N == 1) return {1.0};
  const double x0 = std::cosh(std::acosh(ratio) / (N - 1));
  std::vector<double> pattern;  // at psi = 2 pi k / N; the other half follows by symmetry
  for (int k = 0; k <= (N - 1) / 2; ++k) pattern.push_back(chebyshev(N - 1, x0 * std::cos(kPi * k / N)));

  std::vector<double> weights;
  for (int n = 0; n < N; ++n) {
    const double m = n - 0.5 * (N - 1);
    double sum = pattern[0];
    for (std::size_t k = 1; k < pattern.size(); ++k) {
      sum += 2.0 * pattern[k] * std::cos(2.0 * kPi * static_cast<double>(k) * m / N);
    }
    weights.push_back(sum);
  }
  return weights;
}

/// 1 + 2 sum_p F_p cos(2 pi p m / N): the line whose pattern has its first nbar - 1 zeros at
/// sigma sqrt(A^2 + (q - 1/2)^2) and the uniform line's zeros beyond [Taylor1955].
std::vector<double> taylor(double ratio, int nbar, int N) {
  const double A = std::acosh(ratio) / kPi;
  const double sigma_squared = nbar * nbar / (A * A + (nbar - 0.5) * (nbar - 0.5));
  std::vector<double> F(1, 1.0);
  for (int p = 1; p < nbar; ++p) {
    double value = p % 2 == 1 ? 0.5 : -0.5;
    for (int q = 1; q < nbar; ++q) {
      value *= 1.0 - p * p / (sigma_squared * (A * A + (q - 0.5) * (q - 0.5)));
      if (q != p) value /= 1.0 - static_cast<double>(p * p) / (q * q);
    }
    F.push_back(value);
  }

  std::vector<double> weights;
  for (int n = 0; n < N; ++n) {
    const double m = n - 0.5 * (N - 1);
    double sum = F[0];
    for (int p = 1; p < nbar; ++p) sum += 2.0 * F[static_cast<std::size_t>(p)] * std::cos(2.0 * kPi * p * m / N);
    weights.push_back(sum);
  }
  return weights;
}

std::vector<double> raised_cosine(double mean, double period, int N) {
  std::vector<double> weights;
  for (int n = 0; n < N; ++n) {
    weights.push_back(mean + (1.0 - mean) * std::cos(2.0 * kPi * (n - 0.5 * (N - 1)) / period));
  }
  return weights;
}

/// The level as a ratio of amplitudes.
double checked_ratio(const Shading& shading) {
  if (!(shading.side_lobe_db >= 13.0 && shading.side_lobe_db <= 100.0)) {
    throw std::invalid_argument("side lobes " + std::to_string(shading.side_lobe_db) +
                                " dB below the main lobe: allowed 13 to 100");
  }
  return std::pow(10.0, shading.side_lobe_db / 20.0);
}

void check_nbar(const Shading& shading) {
  const int least = least_nbar(shading.side_lobe_db);
  if (shading.nbar < least || shading.nbar > 100) {
    throw std::invalid_argument("nbar " + std::to_string(shading.nbar) + " of a Taylor shading with side lobes at " +
                                std::to_string(shading.side_lobe_db) + " dB: allowed " + std::to_string(least) +
                                " to 100");
  }
}

std::vector<double> unscaled(const Shading& shading, int N) {
  using Window = Shading::Window;
  switch (shading.window) {
    case Window::kUniform: break;
    case Window::kHann: return raised_cosine(0.5, N + 1, N);
    case Window::kHamming: return raised_cosine(0.54, std::max(N - 1, 1), N);
    case Window::kDolphChebyshev: return dolph_chebyshev(checked_ratio(shading), N);
    case Window::kTaylor: {
      const double ratio = checked_ratio(shading);
      check_nbar(shading);
      return taylor(ratio, shading.nbar, N);
    }
  }
  return std::vector<double>(static_cast<std::size_t>(N), 1.0);
}

}  // namespace

int least_nbar(double side_lobe_db) {
  const double A = std::acosh(std::pow(10.0, side_lobe_db / 20.0)) / kPi;
  return static_cast<int>(std::lround(2.0 * A * A + 0.5));
}

std::vector<double> shading_weights(const Shading& shading, int elements) {
  if (elements < 1) throw std::invalid_argument("an array of " + std::to_string(elements) + " elements: at least 1");
  std::vector<double> weights = unscaled(shading, elements);
  const double largest = *std::max_element(weights.begin(), weights.end());
  for (double& w : weights) w /= largest;
  return weights;
}

double white_noise_gain_db(const std::vector<double>& weights) {
  double sum = 0.0, sum_of_squares = 0.0;
  for (const double w : weights) {
    sum += w;
    sum_of_squares += w * w;
  }
  return 10.0 * std::log10(sum * sum / sum_of_squares);
}

}  // namespace ensonify::array
