#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "kernels/water/refraction/eigenray.h"

namespace ensonify::refraction {

/// Paths side by side at their first passage of a level, in double columns (PathPoint).
struct LevelPaths {
  static constexpr std::size_t kLanes = 16;
  using Column = std::array<double, kLanes>;
  alignas(64) Column invariant_spm, sine, cosine, time_s, length_m, reach_m2ps, width_m, width_slowness;
};

/// All paths of one ping from a source down to one depth, for any launch direction in constant time.
///
/// The path depends on the launch depression alone, so one table serves all azimuths. It is indexed by the sine w of
/// the depression at the fastest depth between source and level: the sines at every other depth are sqrt(a^2 + w^2) up
/// to a factor, so that reach, time and length, times w, vary by little while w changes by a fraction of itself,
/// whatever the profile and however near the path comes to turning. Each octave of w is cut into 16 equal
/// intervals with one cubic each, whose values and slopes at the nodes are exact. Against exact arcs the table is right
/// within 2e-7 of time and length, 2e-7 of the length in place across the path, and 0.0001 dB of the tube area (tests;
/// docs/physics/water/refraction.md has the errors). It serves w from 1/64 (0.9 degrees above turning); flatter paths,
/// those that turn and those that go up are computed leg by leg instead, exactly, at some 50 ns per layer.
class PathTable {
 public:
  /// Builds the table; memory of an earlier build is used again. level_m is the depth down to which rays hit nothing
  /// (the top of the geometry); a level not below the source makes a table without entries, from which every path is
  /// exact. Throws std::invalid_argument for depths that are not finite.
  void build(const SoundSpeedProfile& profile, double source_depth_m, double level_m);

  double source_depth_m() const { return source_depth_m_; }
  double level_m() const { return level_m_; }
  const SoundSpeedProfile& profile() const { return profile_; }

  /// The path at its first passage of the level, or, when the table does not serve it, at the source. The direction is
  /// a unit vector of components along depth and horizontal (>= 0). The table must outlive the path.
  Path path(double sine, double cosine) const;

  /// The same of as many directions as there are lanes. False where the table does not serve one of them: then nothing
  /// is said of any.
  bool paths(const LevelPaths::Column& sine, const LevelPaths::Column& cosine, LevelPaths& found) const;

  /// First point at which a path launched at a depression reaches a depth, turning at most once. Empty when it does
  /// not.
  std::optional<PathEnd> at(double depression_rad, double depth_m) const;

 private:
  struct Cubic {
    double a, b, c, d;  // a + b u + c u^2 + d u^3, u = 0..1 over the interval
    double value(double u) const { return a + u * (b + u * (c + u * d)); }
    double slope(double u) const { return b + u * (2.0 * c + u * 3.0 * d); }
  };
  struct Interval {
    double low, per_width;      // in w
    Cubic reach, time, length;  // each times w
  };
  struct Node;

  SoundSpeedProfile profile_ = SoundSpeedProfile::uniform(1500.0);
  double source_depth_m_ = 0.0;
  double level_m_ = 0.0;
  double source_slowness_spm_ = 1.0 / 1500.0;
  double fastest_mps_ = 1500.0;
  double fall_from_source_ = 0.0;      // (fastest / source speed)^2 - 1
  double rise_to_level_ = 0.0;         // 1 - (level speed / fastest)^2
  PathPoint at_level_;                 // depth, speed, layer
  double level_gradient_per_s_ = 0.0;  // of that layer
  std::vector<Knot> edges_;
  std::vector<Interval> intervals_;
};

}  // namespace ensonify::refraction
