#pragma once

#include <string>

#include "components/config/config_node.h"
#include "kernels/acoustics/trace/ray_distribution.h"

namespace ensonify {

class ConfigReader;

/// How finely a head computes its pings: in a file a factor of rays, or the word `reference`.
///
/// The reference is what every other quality is compared with, however slow: four times the rays; the exact path of
/// each ray, leg by leg; an eigenray to and from each scatterer; patterns to -120 dB. Nothing is merged but the rays of
/// one cell of speckle. See docs/physics/acoustics/reference.md.
struct Quality {
  static constexpr double kFewest = 0.05, kMost = 10.0;

  double rays = 1.0;  // a factor (trace::RaySettings::quality)
  bool reference = false;

  Quality() = default;
  Quality(double factor) : rays(factor) {}  // NOLINT(google-explicit-constructor): as in a file
  static Quality of_reference();

  /// Rays of a head of this range resolution, so many at most. Those of the reference give way at 100 million only.
  trace::RaySettings ray_settings(double range_resolution_m, int most_rays) const;

  /// Largest error of a pattern's amplitude, of 1 on the axis.
  double pattern_error() const { return reference ? 1e-6 : 1e-4; }

  void read(ConfigReader& from, const char* key);
  ConfigNode in_file() const;
  static std::string schema();

  bool operator==(const Quality&) const = default;
};

}  // namespace ensonify
