#pragma once

#include <cmath>
#include <cstddef>
#include <limits>

#include "kernels/refraction/profile.h"

/// Paths of sound where its speed is linear between knots of depth: circular arcs, joined at the knots.
///
/// All is exact (rounding apart) in the high-frequency limit: rays, no diffraction [Jensen2011]. A path stays in the
/// vertical plane of its launch; horizontal distance is counted along that plane and always grows. Directions are given
/// by their depression, the angle below the horizontal, -pi/2..pi/2, positive down. Surface and seabed are unknown
/// here: a path goes on through the profile, which is constant outside its knots.
namespace ensonify::refraction {

/// A place on a path, and what the path did to get there.
struct PathPoint {
  double depth_m = 0.0;
  double speed_mps = 0.0;
  double sine = 0.0;    // of the depression
  double cosine = 0.0;  // >= 0
  double time_s = 0.0;
  double length_m = 0.0;
  double reach_m2ps = 0.0;      // horizontal distance over the Snell invariant: finite on a vertical path too
  double width_m = 0.0;         // how far a path launched 1 rad lower runs beside this one, to first order
  double width_slowness = 0.0;  // its slope, s/m: width grows by this for each m2/s of reach
  std::size_t layer = 0;        // of the profile
};

/// One circular arc, or straight line, in one layer.
struct Leg {
  double chord_m = 0.0;     // straight distance between its ends; infinite if the path never ends there
  double chord_sine = 0.0;  // depression of the chord, which is the mean of those at the ends
  double chord_cosine = 1.0;
  double mean_scale = 0.5;  // 1 over the length of the sum of the unit directions at its ends
  double end_depth_m = 0.0;
  double end_speed_mps = 0.0;
  double end_sine = 0.0;
  double end_cosine = 1.0;
  bool turns = false;  // passes through the horizontal
  bool endless() const { return std::isinf(chord_m); }
};

/// Sound on its way. Steps from knot to knot, or by any smaller leg.
class Path {
 public:
  /// From a depth in a direction; sine and cosine are those of the depression, cosine >= 0, of unit length.
  /// The profile must outlive the path.
  Path(const SoundSpeedProfile& profile, double depth_m, double sine, double cosine);

  /// A path whose way so far is known. `invariant` is cos(depression) / speed, the same all along it (Snell).
  Path(const SoundSpeedProfile& profile, double invariant_spm, double source_slowness_spm, const PathPoint& point)
      : profile_(&profile), invariant_(invariant_spm), source_slowness_(source_slowness_spm), at_(point) {
    settle();
  }

  const PathPoint& at() const { return at_; }
  double invariant_spm() const { return invariant_; }
  double horizontal_m() const { return invariant_ * at_.reach_m2ps; }
  /// Curvature in 1/m, positive where the path bends up.
  double curvature_pm() const { return invariant_ * gradient_; }
  /// Whether the path goes, or is about to bend, down.
  bool heads_down() const { return at_.sine > 0.0 || (at_.sine == 0.0 && gradient_ < 0.0); }

  /// Area of the bundle across the path per steradian of launch; length^2 in uniform water.
  /// At a caustic rays cross and the area vanishes. It is kept above kTubeFloor * length^2: no more than 20 dB louder
  /// than without refraction, which diffraction ensures at any caustic that a sonar meets.
  double tube_m2() const;
  static constexpr double kTubeFloor = 0.01;

  /// To the edge of the layer, or to the planes above and below if they are nearer. The path lies between the planes.
  Leg leg_within(double top_m = -std::numeric_limits<double>::infinity(),
                 double bottom_m = std::numeric_limits<double>::infinity()) const;

  /// Legs within the layer; nothing checks that it is not left.
  Leg leg_of_length(double length_m) const;
  Leg leg_of_horizontal(double horizontal_m) const;
  Leg leg_of_time(double time_s) const;

  double length_of(const Leg& leg) const;
  double time_of(const Leg& leg) const;

  /// Depth at which a leg that turns is horizontal.
  double turning_depth_m() const { return at_.depth_m + (1.0 / invariant_ - at_.speed_mps) / gradient_; }

  /// Goes to the end of a leg.
  void take(const Leg& leg);

 private:
  Leg towards(double sine, double cosine) const;
  /// Chooses the layer, at a knot by the direction.
  void settle() {
    if (at_.depth_m > profile_->layer_top_m(at_.layer) && at_.depth_m < profile_->layer_bottom_m(at_.layer)) {
      gradient_ = profile_->layer_gradient_per_s(at_.layer);
    } else {
      settle_at_knot();
    }
  }
  void settle_at_knot();

  const SoundSpeedProfile* profile_;
  double invariant_;
  double source_slowness_;
  double gradient_ = 0.0;
  PathPoint at_;
};

}  // namespace ensonify::refraction
