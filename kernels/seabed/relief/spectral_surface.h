#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "kernels/base/random/stream.h"
#include "kernels/seabed/relief/spectrum.h"
#include "kernels/seabed/relief/window.h"

namespace ensonify::relief {

/// A Gaussian random surface of a given spectrum, whose height at a post is a function of (seed, name, post).
///
/// White noise on the nodes of each level of the lattice, carried down to the posts by the refinement of quintic
/// splines: level k costs a fourth of level k - 1, so all octaves together cost a third more than the finest alone.
/// Octaves below the posts are white noise at the posts, as they are on a real surface that is sampled there.
///
/// At level k of a window the octaves whose nodes are closer than the window's are left out.
///
/// `amplitude`, if given, multiplies the noise at the nodes where each octave is made: a sharp border in it is as sharp
/// as each octave can show, and leaves no step in the height. It is asked for at every level.
class SpectralSurface {
 public:
  SpectralSurface(const Spectrum& spectrum, double post_spacing_m, std::uint64_t seed, std::string_view name);

  /// Writes heights, m, mean 0.
  void fill(const Window& window, std::span<float> height_m, const Field& amplitude = nullptr) const;

  const Spectrum& spectrum() const { return spectrum_; }
  const Octaves& octaves() const { return octaves_; }

 private:
  Spectrum spectrum_;
  Octaves octaves_;
  std::vector<float> node_sd_m_;  // by level
  random::Stream octave_noise_;
  random::Stream post_noise_;
};

/// An amplitude that makes a spectral surface multifractal: rough places within rough places, at every scale.
///
/// The lognormal cascade of [Kolmogorov1962] as a random measure [Bacry2001]: ln amplitude is a sum of smooth Gaussian
/// noises, one per octave from the outer scale down to the octave where it is used, each of variance lambda^2 ln 2. The
/// mean square is 1, so spectrum and rms stay what they are, and the structure functions go as
///   E|dz|^q ~ r^zeta(q),  zeta(q) = q H + lambda^2 q - lambda^2 q^2 / 2,
/// so K2 = 2 zeta(1) - zeta(2) = lambda^2 where many octaves lie above the lags; with six above lags of 1 to 32 posts,
/// about two thirds of it. Rough patches are also the steep ones, as on measured rock (K2 0.12-0.35).
struct CascadeParameters {
  double intermittency = 0.0;  // lambda^2, 0 (plain) to 0.7
  double outer_scale_m = 1.0;  // as of the surface
  int finest_level = 2;        // the amplitude has no detail below nodes 2^this posts apart
};

class LognormalCascade {
 public:
  LognormalCascade(const CascadeParameters& parameters, double post_spacing_m, std::uint64_t seed,
                   std::string_view name);

  /// The amplitude of the octave of the window's level, a Field for SpectralSurface::fill.
  void fill(const Window& window, std::span<float> amplitude) const;

  /// Variance of ln amplitude in the octaves with all its detail, those of the posts. Half of all places have less
  /// than exp(-2 of it) of the mean square, which few rough ones make.
  double ln_variance() const;

 private:
  float node_sd_ = 0.0F;
  int coarsest_ = 0;
  int finest_ = 0;
  random::Stream noise_;
};

/// Higher places are rougher (gain > 0), or hollows are: amplitude exp(gain u - gain^2 var u), u the height of
/// `reference` over its rms, as far as octaves coarser than the window's level make it. Mean square 1. Give it the
/// surface that it will modulate: same noise, so the amplitude follows the height that it helps to make.
class HeightGain {
 public:
  HeightGain(SpectralSurface reference, double gain, int finest_level = 2);
  void fill(const Window& window, std::span<float> amplitude) const;

  /// As LognormalCascade's.
  double ln_variance() const;

 private:
  double ln_variance(int level) const;

  SpectralSurface reference_;
  double gain_;
  int finest_;
};

/// Runs `at_level` on a window of `finest_level` and carries its numbers down to `window` by refinement, as spline
/// coefficients; calls it directly if the window is not finer. For what varies slowly and costs much.
void fill_from_level(int finest_level, const Field& at_level, const Window& window, std::span<float> out);

}  // namespace ensonify::relief
