#pragma once

#include <cstdint>
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

}  // namespace ensonify::relief
