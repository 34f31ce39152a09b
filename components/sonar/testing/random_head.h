#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "kernels/acoustics/array/shading.h"
#include "kernels/base/random/stream.h"

/// For tests: random legal parameters of heads, as YAML.
namespace ensonify {

/// Numbers for one case: the n-th one asked for.
class Draws {
 public:
  explicit Draws(std::uint64_t number) : number_(number) {}
  double between(double low, double high) { return low + (high - low) * stream_.uniform(number_, next_++); }
  /// Spread evenly over orders of magnitude.
  double scale(double low, double high) { return std::exp(between(std::log(low), std::log(high))); }
  int whole(int low, int high) { return static_cast<int>(between(low, high + 1)); }
  bool yes() { return between(0.0, 1.0) < 0.5; }

 private:
  random::Stream stream_{1, "cases"};
  std::uint64_t number_, next_ = 0;
};

inline std::string effects_yaml(Draws& draw) {
  std::string yaml = "effects:\n";
  for (const char* effect : {"refraction", "absorption", "directivity", "side_lobes", "speckle", "noise", "volume",
                             "multipath", "motion", "tvg", "quantisation"}) {
    yaml += fmt::format("  {}: {}\n", effect, draw.between(0, 1) < 0.8);
  }
  return yaml;
}

inline std::string lod_yaml(Draws& draw) {
  return fmt::format("lod: {{ enabled: {}, side_lobes: {} }}\n", draw.yes(), draw.whole(0, 5));
}

/// The length of a pulse, and half of the time the sweep that makes a chirp of it.
struct RandomPulse {
  double length_s, band_hz;
  std::string yaml;
};
inline RandomPulse random_pulse(Draws& draw, const char* indent) {
  const char* const windows[] = {"none", "hann", "hamming", "blackman"};
  RandomPulse pulse{draw.scale(3e-5, 1e-3), 0.0, {}};
  const double sweep_hz = draw.between(4.1, 6.0) / pulse.length_s;
  const bool chirp = draw.yes();
  pulse.band_hz = chirp ? sweep_hz : 1.0 / pulse.length_s;
  pulse.yaml = fmt::format("{}pulse_length_s: {}\n", indent, pulse.length_s);
  if (chirp) {
    pulse.yaml += fmt::format("{0}pulse: chirp\n{0}bandwidth_hz: {1}\n{0}window: {2}\n", indent, sweep_hz,
                              windows[draw.whole(0, 3)]);
  } else {
    pulse.yaml += fmt::format("{}pulse: tone\n", indent);
  }
  return pulse;
}

inline std::string shading_yaml(Draws& draw, const char* key) {
  const char* const windows[] = {"uniform", "hann", "hamming", "dolph_chebyshev", "taylor"};
  const double side_lobe_db = draw.between(13, 60);
  return fmt::format("{}: {{ window: {}, side_lobe_db: {}, nbar: {} }}\n", key, windows[draw.whole(0, 4)], side_lobe_db,
                     draw.whole(array::least_nbar(side_lobe_db), 20));
}

/// Parameters of a head. Its folder may draw more than those that all heads have: testing/random_parameters.h. Ranges
/// and samples are kept small there, for speed; all else goes to the ends of what its reader allows.
template <class Node>
struct RandomParameters {
  static std::string yaml(Draws& draw) {
    const int bits = draw.yes() ? 0 : draw.whole(1, 16);
    return fmt::format("quality: 0.1\nconverter:\n  bits: {}\n", bits) + lod_yaml(draw) + effects_yaml(draw);
  }
};

}  // namespace ensonify
