#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "kernels/water/refraction/profile.h"

/// Paths of sound where its speed is linear between knots of depth: circular arcs, joined at the knots.
///
/// All is exact (rounding apart) in the high-frequency limit: rays, no diffraction [Jensen2011]. A path stays in the
/// vertical plane of its launch; horizontal distance is counted along that plane and always grows. Directions are given
/// by their depression, the angle below the horizontal, -pi/2..pi/2, positive down. Surface and seabed are unknown
/// here: a path goes on through the profile, which is constant outside its knots.
namespace ensonify::refraction {

// Functions over their argument, 1 at zero; series where digits would be lost, neglected terms below 1e-13.

// The series, which nearly every leg takes, are small enough to be compiled into their callers.

[[gnu::noinline]] inline double asin_over_large(double v) { return std::asin(std::clamp(v, -1.0, 1.0)) / v; }
[[gnu::noinline]] inline double asinh_over_large(double u) { return std::asinh(u) / u; }

inline double asin_over(double v) {
  const double v2 = v * v;
  return v2 < 1e-4 ? 1.0 + v2 * (1.0 / 6 + v2 * (3.0 / 40)) : asin_over_large(v);
}
inline double asinh_over(double u) {
  const double u2 = u * u;
  return u2 < 1e-4 ? 1.0 - u2 * (1.0 / 6 - u2 * (3.0 / 40)) : asinh_over_large(u);
}
inline double sinh_over(double u) { return std::abs(u) < 1e-3 ? 1.0 + u * u / 6 : std::sinh(u) / u; }

/// Length of a circular arc over its chord.
inline double arc_m(double curvature_pm, double chord_m) { return chord_m * asin_over(0.5 * curvature_pm * chord_m); }

/// Travel time between two points of a medium with a linear gradient of speed: (2/g) arsinh(g L / (2 sqrt(c1 c2))).
inline double arc_s(double gradient_per_s, double chord_m, double speed_1_mps, double speed_2_mps) {
  const double mean = 1.0 / (speed_1_mps + speed_2_mps), part = mean * (speed_2_mps - speed_1_mps), e = part * part;
  const double slowness =  // 1 / sqrt(c1 c2) = 1 / (mean speed sqrt(1 - e))
      e < 1e-5 ? 2.0 * mean * (1.0 + e * (0.5 + 0.375 * e)) : 1.0 / std::sqrt(speed_1_mps * speed_2_mps);
  return chord_m * slowness * asinh_over(0.5 * gradient_per_s * chord_m * slowness);
}

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
  /// At a caustic rays cross and the area vanishes. It is kept above kTubeFloor * length^2: no more than 20 dB stronger
  /// than without refraction, which diffraction ensures at any caustic that a sonar hits.
  double tube_m2() const { return tube_m2(at_); }
  /// The same at another place on this path.
  double tube_m2(const PathPoint& point) const {
    const double area = point.reach_m2ps * source_slowness_ * std::abs(point.width_m);
    return std::max(area, kTubeFloor * point.length_m * point.length_m);
  }
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

  /// State at the end of a leg within the layer.
  PathPoint end_of(const Leg& leg) const;

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

// The steps that every ray takes are here for the compiler to see.

/// A leg with a given direction at its end; its length and place are still open.
inline Leg Path::towards(double sine, double cosine) const {
  // The sum of two unit vectors that differ by d has length sqrt(4 - d^2).
  const double d_sine = at_.sine - sine, d_cosine = at_.cosine - cosine, d2 = d_sine * d_sine + d_cosine * d_cosine;
  const double mean_scale = d2 < 1e-5 ? 0.5 + d2 * (1.0 / 16 + d2 * (3.0 / 256)) : 1.0 / std::sqrt(4.0 - d2);
  Leg leg;
  leg.chord_sine = mean_scale * (at_.sine + sine);
  leg.chord_cosine = mean_scale * (at_.cosine + cosine);
  leg.mean_scale = mean_scale;
  leg.end_sine = sine;
  leg.end_cosine = cosine;
  leg.turns = at_.sine * sine < 0.0;
  return leg;
}

inline Leg Path::leg_within(double top_m, double bottom_m) const {
  const double top = std::max(top_m, profile_->layer_top_m(at_.layer));
  const double bottom = std::min(bottom_m, profile_->layer_bottom_m(at_.layer));
  const bool down = heads_down();
  Leg endless;
  endless.chord_m = std::numeric_limits<double>::infinity();
  endless.chord_sine = endless.end_sine = at_.sine;
  endless.chord_cosine = endless.end_cosine = at_.cosine;
  if (at_.sine == 0.0 && gradient_ == 0.0) return endless;

  double depth = down ? bottom : top;
  if (std::isinf(depth)) return endless;
  // Squared sine at a depth, without the cancellation of 1 - cos^2.
  const auto squared_sine = [&](double to_depth) {
    const double rise = invariant_ * gradient_ * (to_depth - at_.depth_m);
    return at_.sine * at_.sine - rise * (2.0 * at_.cosine + rise);
  };
  double squared = squared_sine(depth);
  const bool turns = squared <= 0.0;
  if (turns) {
    depth = down ? top : bottom;
    if (std::isinf(depth)) return endless;  // cannot be: a layer without end has no gradient
    squared = std::max(squared_sine(depth), 0.0);
  }
  const double sine = (down != turns ? 1.0 : -1.0) * std::sqrt(squared);
  const double speed = profile_->speed_in_layer_mps(at_.layer, depth);
  Leg leg = towards(sine, invariant_ * speed);
  leg.turns = turns;
  leg.end_depth_m = depth;
  leg.end_speed_mps = speed;
  leg.chord_m = turns ? (at_.sine - sine) / (curvature_pm() * leg.chord_cosine)
                      : (depth == at_.depth_m ? 0.0 : (depth - at_.depth_m) / leg.chord_sine);
  return leg;
}

inline Leg Path::leg_of_length(double length_m) const {
  const double turn = curvature_pm() * length_m, t2 = turn * turn;
  const bool small = t2 < 1e-5;  // most legs: a few terms give all digits
  const double c = small ? 1.0 - t2 * (0.5 - t2 / 24) : std::cos(turn);
  const double s = small ? turn * (1.0 - t2 * (1.0 / 6 - t2 / 120)) : std::sin(turn);
  Leg leg = towards(at_.sine * c - at_.cosine * s, at_.cosine * c + at_.sine * s);
  leg.chord_m = length_m * (small ? 1.0 - t2 / 24 : std::sin(0.5 * turn) / (0.5 * turn));
  leg.end_depth_m = at_.depth_m + leg.chord_m * leg.chord_sine;
  leg.end_speed_mps = at_.speed_mps + gradient_ * leg.chord_m * leg.chord_sine;
  return leg;
}

inline double Path::length_of(const Leg& leg) const { return arc_m(curvature_pm(), leg.chord_m); }

inline double Path::time_of(const Leg& leg) const {
  return arc_s(gradient_, leg.chord_m, at_.speed_mps, leg.end_speed_mps);
}

inline PathPoint Path::end_of(const Leg& leg) const {
  // horizontal / invariant: chord cosine / invariant, with cosines = invariant * speed
  const double reach = leg.chord_m * leg.mean_scale * (at_.speed_mps + leg.end_speed_mps);
  return {.depth_m = leg.end_depth_m,
          .speed_mps = leg.end_speed_mps,
          .sine = leg.end_sine,
          .cosine = leg.end_cosine,
          .time_s = at_.time_s + time_of(leg),
          .length_m = at_.length_m + length_of(leg),
          .reach_m2ps = at_.reach_m2ps + reach,
          .width_m = at_.width_m + at_.width_slowness * reach,
          .width_slowness = at_.width_slowness,
          .layer = at_.layer};
}

}  // namespace ensonify::refraction
