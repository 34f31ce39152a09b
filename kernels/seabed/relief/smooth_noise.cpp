#include "kernels/seabed/relief/smooth_noise.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "kernels/seabed/relief/intermittency.h"
#include "kernels/seabed/relief/spline.h"

namespace ensonify::relief {

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

}  // namespace ensonify::relief
