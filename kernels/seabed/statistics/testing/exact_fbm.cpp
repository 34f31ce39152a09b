#include "kernels/seabed/statistics/testing/exact_fbm.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>
#include <string>

#include "kernels/base/fft/transform.h"
#include "kernels/base/random/stream.h"

namespace ensonify::relief_statistics {
namespace {

/// Covariance of the stationary part, rho in diagonals: c0 - rho^2H + c2 rho^2 to 1, b (R - rho)^3 / rho to R, 0
/// beyond. c0, c2 and b make it smooth [Stein2002]; with R = 1 nothing lies between.
class Embedding {
 public:
  explicit Embedding(double hurst) : hurst_(hurst), reach_(hurst <= 0.75 ? 1.0 : 2.0) {
    const double alpha = 2.0 * hurst, R = reach_;
    b_ = R > 1.0 ? alpha * (2.0 - alpha) / (3.0 * R * (R * R - 1.0)) : 0.0;
    c2_ = 0.5 * (alpha - b_ * (R - 1.0) * (R - 1.0) * (R + 2.0));
    c0_ = b_ * std::pow(R - 1.0, 3.0) + 1.0 - c2_;
  }
  double covariance(double rho) const {
    if (rho < 1.0) return c0_ - std::pow(rho, 2.0 * hurst_) + c2_ * rho * rho;
    return rho < reach_ ? b_ * std::pow(reach_ - rho, 3.0) / rho : 0.0;
  }
  double reach() const { return reach_; }
  double c2() const { return c2_; }

 private:
  double hurst_, reach_, b_, c2_, c0_;
};

}  // namespace

Surface exact_fbm(double hurst, int posts, const random::Stream& stream, std::uint64_t number) {
  if (!(hurst > 0.0 && hurst <= 0.95))
    throw std::invalid_argument("exact_fbm: hurst is " + std::to_string(hurst) + ", allowed: above 0, at most 0.95");
  if (posts < 2 || posts > 2048)
    throw std::invalid_argument("exact_fbm: posts is " + std::to_string(posts) + ", allowed: 2 to 2048");
  // In units of the diagonal all usable pairs have rho <= 1; a period of twice the covariance's reach holds them.
  const Embedding embedding(hurst);
  const double diagonal = std::numbers::sqrt2 * posts;
  const int period = fft::Transform::good_size(static_cast<int>(std::ceil(2.0 * embedding.reach() * diagonal)));
  const auto n = static_cast<std::size_t>(period);
  std::vector<std::complex<float>> plane(n * n);
  for (int j = 0; j < period; ++j) {
    for (int i = 0; i < period; ++i) {
      const double rho = std::hypot(std::min(i, period - i), std::min(j, period - j)) / diagonal;
      plane[static_cast<std::size_t>(j) * n + static_cast<std::size_t>(i)] =
          static_cast<float>(embedding.covariance(rho));
    }
  }
  fft::transform_plane(plane, period, period, fft::Transform::Sign::kMinus);
  std::vector<std::complex<float>> noise(n * n);
  random::add_gaussian(stream, number, 0, 1.0F, noise);
  const double cells = static_cast<double>(period) * period;
  for (std::size_t i = 0; i < plane.size(); ++i) {
    const double power = std::max(0.0, static_cast<double>(plane[i].real()));  // rounding leaves some below 0
    noise[i] *= static_cast<float>(std::sqrt(power / cells));
  }
  fft::transform_plane(noise, period, period, fft::Transform::Sign::kPlus);
  // Heights in units of r^(2 H), r in posts: D of the field is 2 (rho^2H - c2 rho^2); the tilt returns c2 rho^2.
  const double unit = std::pow(diagonal, hurst) / std::numbers::sqrt2;
  const auto tilt = stream.normal_pair(number, ~std::uint64_t{0}, 1);
  Surface surface{posts, posts, 1.0, {}};
  for (int j = 0; j < posts; ++j) {
    for (int i = 0; i < posts; ++i) {
      const double z = noise[static_cast<std::size_t>(j) * n + static_cast<std::size_t>(i)].real() - noise[0].real();
      const double plane_z = std::sqrt(2.0 * embedding.c2()) * (tilt[0] * i + tilt[1] * j) / diagonal;
      surface.height_m.push_back(static_cast<float>(unit * (z + plane_z)));
    }
  }
  return surface;
}

double structure_function(const Surface& surface, int lag_cells, double order) {
  check(surface);
  double sum = 0.0, pairs = 0.0;
  const auto add = [&](float a, float b) {
    const double difference = std::abs(static_cast<double>(a) - static_cast<double>(b));
    if (std::isnan(difference)) return;
    sum += std::pow(difference, order);
    pairs += 1.0;
  };
  for (int j = 0; j < surface.rows; ++j) {
    for (int i = 0; i + lag_cells < surface.columns; ++i) add(surface.at(i, j), surface.at(i + lag_cells, j));
    if (j + lag_cells >= surface.rows) continue;
    for (int i = 0; i < surface.columns; ++i) add(surface.at(i, j), surface.at(i, j + lag_cells));
  }
  return sum / pairs;
}

}  // namespace ensonify::relief_statistics
