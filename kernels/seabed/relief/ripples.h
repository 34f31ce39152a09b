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

/// Sand ripples, megaripples or dunes: one train of waves.
struct RippleParameters {
  double wavelength_m = 1.0;       // > 0
  double height_m = 0.1;           // crest to trough, mean; see flemming_height_m
  double travel_heading_rad = 0;   // grid heading that the lee sides face; crests run across it
  double lee_fraction = 0.5;       // of the wavelength under the lee side: 0.3 (steep lee) to 0.5 (symmetric)
  double disorder = 0.3;           // 0: straight endless crests; towards 1 bent, short, forked ones
  double patch_wavelengths = 2.0;  // over how many wavelengths crests bend and heights change, > 0
  double height_ln_sd = 0.3;       // of ln height from place to place; measured 0.38-0.5, on large dunes 0.1
};

/// Height of the waves about their mean, m.
///
/// z = height / 2 * a * p(theta), p(theta) = (cos theta + b sin 2 theta) / its largest value: crest at theta_c with
/// sin theta_c = (sqrt(1 + 32 b^2) - 1) / 8b, trough at pi - theta_c, so that b follows from the lee fraction, and the
/// lee is steepest midway: pi height (1 + 2 b) / (wavelength * largest value).
/// theta is the phase of exp(i k.x) N, where N = (1 - disorder) + disorder * (complex Gaussian noise). Where N
/// vanishes its phase turns by one wave: there a crest ends or forks, as in nature, and the amplitude
/// a = |N| sqrt(1.1 / (|N|^2 + 0.1)) goes to 0. Zeros of Gaussian noise (disorder 1) have the density
/// 0.151 / length^2 [Berry2000], length the noise's.
///
/// At levels whose nodes are more than a fourth of the wavelength apart, there are no waves.
class Ripples {
 public:
  Ripples(const RippleParameters& parameters, double post_spacing_m, std::uint64_t seed, std::string_view name);

  void fill(const Window& window, std::span<float> height_m) const;

  /// exp(i k.x) N, whose zeros are the defects.
  void phase(const Window& window, std::span<float> real, std::span<float> imaginary) const;

  double steepest_lee() const { return steepest_lee_; }  // m per m, of a wave of mean height
  double noise_length_m() const { return real_.length_m(); }

 private:
  RippleParameters parameters_;
  double post_spacing_m_;
  float b_ = 0.0F, half_height_m_ = 0.0F;
  double steepest_lee_ = 0.0;
  SmoothNoise real_, imaginary_, height_;
};

/// Mean height of bedforms of a wavelength, 0.0677 wavelength^0.8098 [Flemming1988]; the dunes of two surveys stood at
/// 0.5 to 0.8 of it.
double flemming_height_m(double wavelength_m);

}  // namespace ensonify::relief
