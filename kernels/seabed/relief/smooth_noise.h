#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "kernels/base/random/stream.h"
#include "kernels/seabed/relief/window.h"

namespace ensonify::relief {

/// One octave of Gaussian noise, mean 0, variance 1, correlation near exp(-(r / length)^2 / 2): what makes crests bend
/// and heights vary. The length is rounded to a power of two of posts, at least four.
class SmoothNoise {
 public:
  SmoothNoise(double length_m, double post_spacing_m, std::uint64_t seed, std::string_view name);
  void fill(const Window& window, std::span<float> out) const;

  /// Distance of the noise's nodes, which is the correlation length in use.
  double length_m() const { return length_m_; }

 private:
  int level_;
  double length_m_;
  random::Stream noise_;
};

}  // namespace ensonify::relief
