#include "kernels/instruments/inertial/testing/allan.h"

#include <cmath>
#include <stdexcept>
#include <string>

namespace ensonify::inertial {

std::vector<AllanPoint> allan_deviation(std::span<const double> readings, double interval_s,
                                        std::span<const std::size_t> samples_per_mean) {
  if (!(interval_s > 0.0)) throw std::invalid_argument("allan_deviation: the interval must be above 0");
  std::vector<double> integral(readings.size() + 1, 0.0);
  for (std::size_t i = 0; i < readings.size(); ++i) integral[i + 1] = integral[i] + interval_s * readings[i];

  std::vector<AllanPoint> points;
  for (const std::size_t m : samples_per_mean) {
    if (m < 1 || 2 * m > readings.size()) {
      throw std::invalid_argument("allan_deviation: " + std::to_string(m) + " samples per mean of " +
                                  std::to_string(readings.size()) + "; from 1 to half of them are allowed");
    }
    const double tau = static_cast<double>(m) * interval_s;
    double sum = 0.0;
    for (std::size_t k = 0; k + 2 * m < integral.size(); ++k) {
      const double second = integral[k + 2 * m] - 2.0 * integral[k + m] + integral[k];
      sum += second * second;
    }
    const auto count = static_cast<double>(integral.size() - 2 * m);
    points.push_back({tau, std::sqrt(sum / (2.0 * tau * tau * count))});
  }
  return points;
}

std::vector<std::size_t> octaves(std::size_t readings, std::size_t shortest_share) {
  std::vector<std::size_t> sizes;
  for (std::size_t m = 1; m * shortest_share <= readings; m *= 2) sizes.push_back(m);
  return sizes;
}

double allan_of_white(double random_walk, double time_s) { return random_walk / std::sqrt(time_s); }

double allan_of_rate_random_walk(double rate_random_walk, double time_s) {
  return rate_random_walk * std::sqrt(time_s / 3.0);
}

double allan_of_gauss_markov(double sigma, double correlation_s, double time_s) {
  const double x = time_s / correlation_s;
  if (x < 1e-3) return sigma * std::sqrt(2.0 * x / 3.0 - 0.5 * x * x);  // the bracket is x^2 / 3 - x^3 / 4 + ...
  const double bracket = 1.0 - (3.0 - 4.0 * std::exp(-x) + std::exp(-2.0 * x)) / (2.0 * x);
  return sigma * std::sqrt(2.0 / x * bracket);
}

double allan_of_quantum(double quantum, double time_s) { return quantum / (2.0 * time_s); }

double gauss_markov_sigma_of_instability(double bias_instability) { return 0.664 / 0.6173643 * bias_instability; }

}  // namespace ensonify::inertial
