#include "kernels/seabed/relief/ripples.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "kernels/seabed/relief/exponential.h"
#include "kernels/seabed/relief/spectral_surface.h"
#include "kernels/seabed/relief/spline.h"
#include "kernels/seabed/relief/spline_variance.h"

namespace ensonify::relief {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr float kSoftCore = 0.1F;  // of |N|^2: within the core of a defect waves fade

void require(bool allowed, const std::string& what, double value, const std::string& range) {
  if (!allowed)
    throw std::invalid_argument("ripples: " + what + " is " + std::to_string(value) + ", allowed: " + range);
}

const RippleParameters& checked(const RippleParameters& p) {
  require(p.wavelength_m > 0.0, "wavelength_m", p.wavelength_m, "more than 0");
  require(p.height_m >= 0.0, "height_m", p.height_m, "0 or more");
  require(p.lee_fraction >= 0.3 && p.lee_fraction <= 0.5, "lee_fraction", p.lee_fraction, "0.3 to 0.5");
  require(p.disorder >= 0.0 && p.disorder <= 1.0, "disorder", p.disorder, "0 to 1");
  require(p.patch_wavelengths > 0.0, "patch_wavelengths", p.patch_wavelengths, "more than 0");
  require(p.height_ln_sd >= 0.0 && p.height_ln_sd <= 1.0, "height_ln_sd", p.height_ln_sd, "0 to 1");
  return p;
}

/// Cosine and sine of the phase at whole-numbered nodes along one axis.
struct Turns {
  std::vector<float> cosine, sine;
};

Turns turns_of(std::int64_t first, int count, double turns_per_node) {
  Turns turns;
  for (int i = 0; i < count; ++i) {
    const double turn = static_cast<double>(first + i) * turns_per_node, angle = 2.0 * kPi * (turn - std::floor(turn));
    turns.cosine.push_back(static_cast<float>(std::cos(angle)));
    turns.sine.push_back(static_cast<float>(std::sin(angle)));
  }
  return turns;
}

}  // namespace

SmoothNoise::SmoothNoise(double length_m, double post_spacing_m, std::uint64_t seed, std::string_view name)
    : noise_(seed, name) {
  if (!(length_m > 0.0 && post_spacing_m > 0.0))
    throw std::invalid_argument("smooth noise: length and spacing must be positive");
  level_ = std::max(2, static_cast<int>(std::lround(std::log2(length_m / post_spacing_m))));
  length_m_ = node_spacing_m(post_spacing_m, level_);
}

void SmoothNoise::fill(const Window& window, std::span<float> out) const {
  const auto white = [this](const Window& nodes, std::span<float> coefficient) {
    std::fill(coefficient.begin(), coefficient.end(), 0.0F);
    add_white(noise_, static_cast<float>(1.0 / std::sqrt(variance_of_coefficients(level_))), {}, nodes, coefficient);
  };
  fill_from_level(level_, white, window, out);
}

Ripples::Ripples(const RippleParameters& parameters, double post_spacing_m, std::uint64_t seed, std::string_view name)
    : parameters_(checked(parameters)),
      post_spacing_m_(post_spacing_m),
      real_(parameters.patch_wavelengths * parameters.wavelength_m, post_spacing_m, seed, std::string(name) + "/real"),
      imaginary_(parameters.patch_wavelengths * parameters.wavelength_m, post_spacing_m, seed,
                 std::string(name) + "/imaginary"),
      height_(parameters.patch_wavelengths * parameters.wavelength_m, post_spacing_m, seed,
              std::string(name) + "/height") {
  const double crest = kPi * (0.5 - parameters.lee_fraction), sine = std::sin(crest);
  const double b = sine / (2.0 * (1.0 - 2.0 * sine * sine));
  const double largest = std::cos(crest) + b * std::sin(2.0 * crest);
  b_ = static_cast<float>(b);
  half_height_m_ = static_cast<float>(0.5 * parameters.height_m / largest);
  steepest_lee_ = kPi * parameters.height_m * (1.0 + 2.0 * b) / (parameters.wavelength_m * largest);
}

void Ripples::phase(const Window& window, std::span<float> real, std::span<float> imaginary) const {
  const double waves_per_node = node_spacing_m(post_spacing_m_, window.level) / parameters_.wavelength_m;
  const Turns east = turns_of(window.east, window.columns, waves_per_node * std::sin(parameters_.travel_heading_rad));
  const Turns north = turns_of(window.north, window.rows, waves_per_node * std::cos(parameters_.travel_heading_rad));
  real_.fill(window, real);
  imaginary_.fill(window, imaginary);
  const auto mean = static_cast<float>(1.0 - parameters_.disorder);
  const auto random = static_cast<float>(parameters_.disorder / std::numbers::sqrt2);  // E|noise|^2 = 1
  for (int j = 0; j < window.rows; ++j) {
    const auto row = static_cast<std::size_t>(j);
    const float nc = north.cosine[row], ns = north.sine[row];
    float *re = real.data() + window.node(0, j), *im = imaginary.data() + window.node(0, j);
    for (std::size_t i = 0; i < east.cosine.size(); ++i) {
      const float c = east.cosine[i] * nc - east.sine[i] * ns, s = east.cosine[i] * ns + east.sine[i] * nc;
      const float n_re = mean + random * re[i], n_im = random * im[i];
      re[i] = c * n_re - s * n_im;
      im[i] = c * n_im + s * n_re;
    }
  }
}

void Ripples::fill(const Window& window, std::span<float> height_m) const {
  if (4.0 * node_spacing_m(post_spacing_m_, window.level) > parameters_.wavelength_m) {
    std::fill(height_m.begin(), height_m.end(), 0.0F);
    return;
  }
  std::vector<float> re(window.size()), im(window.size());
  phase(window, re, im);
  height_.fill(window, height_m);
  const auto ln_sd = static_cast<float>(parameters_.height_ln_sd), half_variance = 0.5F * ln_sd * ln_sd;
  for (std::size_t i = 0; i < re.size(); ++i) {
    // With c = re / |N|, s = im / |N|: a (c + 2 b s c), without dividing by |N| alone.
    const float square = re[i] * re[i] + im[i] * im[i];
    const float amplitude = std::sqrt((1.0F + kSoftCore) / (square + kSoftCore));  // a / |N|
    const float tilt = 2.0F * b_ * im[i] / std::sqrt(square + 1e-12F);
    height_m[i] = half_height_m_ * exponential(ln_sd * height_m[i] - half_variance) * amplitude * re[i] * (1.0F + tilt);
  }
}

double flemming_height_m(double wavelength_m) { return 0.0677 * std::pow(wavelength_m, 0.8098); }

}  // namespace ensonify::relief
