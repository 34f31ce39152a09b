#include "kernels/refraction/path.h"

#include <algorithm>

#include "kernels/refraction/arc.h"

namespace ensonify::refraction {
namespace {

constexpr double kEndless = std::numeric_limits<double>::infinity();

/// Flatter than this on the axis of a sound channel, a path stays within 0.1 mm of the axis (for any gradient above
/// 0.05 1/s; weaker ones let it stray in proportion) and is taken to run along it.
constexpr double kAxisSine = 1e-4;

/// A path that only touches a knot spreads without bound in theory; this keeps the numbers finite.
constexpr double kTangentSine = 1e-6;

}  // namespace

Path::Path(const SoundSpeedProfile& profile, double depth_m, double sine, double cosine) : profile_(&profile) {
  at_.layer = profile.layer_at(depth_m);
  at_.depth_m = depth_m;
  at_.speed_mps = profile.speed_in_layer_mps(at_.layer, depth_m);
  at_.sine = sine;
  at_.cosine = cosine;
  at_.width_slowness = 1.0 / at_.speed_mps;
  source_slowness_ = at_.width_slowness;
  invariant_ = cosine * source_slowness_;
  settle();
}

double Path::tube_m2() const {
  const double area = at_.reach_m2ps * source_slowness_ * std::abs(at_.width_m);
  return std::max(area, kTubeFloor * at_.length_m * at_.length_m);
}

void Path::settle_at_knot() {
  const auto leave = [&](std::size_t next) {
    // The width's slope jumps with the gradient: from the derivative of Snell's law at the knot.
    const double jump = profile_->layer_gradient_per_s(next) - profile_->layer_gradient_per_s(at_.layer);
    const double sine = std::copysign(std::max(std::abs(at_.sine), kTangentSine), at_.sine);
    at_.width_slowness -= at_.width_m * invariant_ * invariant_ * jump / sine;
    at_.layer = next;
  };
  const bool on_top = at_.depth_m <= profile_->layer_top_m(at_.layer);
  const bool on_bottom = at_.depth_m >= profile_->layer_bottom_m(at_.layer);
  if (on_top || on_bottom) {
    const std::size_t above = on_top ? at_.layer - 1 : at_.layer, below = above + 1;
    const bool rises_back = profile_->layer_gradient_per_s(below) > 0.0;  // bends up below the knot
    const bool sinks_back = profile_->layer_gradient_per_s(above) < 0.0;
    if (rises_back && sinks_back && std::abs(at_.sine) < kAxisSine) {
      at_.sine = 0.0;
      at_.cosine = 1.0;
      gradient_ = 0.0;
      return;
    }
    const bool goes_up = at_.sine < 0.0 || (at_.sine == 0.0 && profile_->layer_gradient_per_s(below) > 0.0);
    if (goes_up && at_.layer == below) leave(above);
    if (!goes_up && at_.layer == above) leave(below);
  }
  gradient_ = profile_->layer_gradient_per_s(at_.layer);
}

/// A leg with a given direction at its end; its length and place are still open.
Leg Path::towards(double sine, double cosine) const {
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

Leg Path::leg_within(double top_m, double bottom_m) const {
  const double top = std::max(top_m, profile_->layer_top_m(at_.layer));
  const double bottom = std::min(bottom_m, profile_->layer_bottom_m(at_.layer));
  const bool down = heads_down();
  Leg endless;
  endless.chord_m = kEndless;
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

Leg Path::leg_of_length(double length_m) const {
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

Leg Path::leg_of_horizontal(double horizontal_m) const {
  const double sine = at_.sine - curvature_pm() * horizontal_m;
  const double squared = at_.cosine * at_.cosine + (at_.sine - sine) * (at_.sine + sine);
  Leg leg = towards(sine, std::sqrt(std::max(squared, 0.0)));
  leg.chord_m = horizontal_m / leg.chord_cosine;
  leg.end_depth_m = at_.depth_m + leg.chord_m * leg.chord_sine;
  leg.end_speed_mps = at_.speed_mps + gradient_ * leg.chord_m * leg.chord_sine;
  return leg;
}

Leg Path::leg_of_time(double time_s) const {
  // Along an arc d(artanh(sine))/dt = -gradient.
  const double turn = gradient_ * time_s;
  const double t = std::tanh(turn), shrink = 1.0 / (std::cosh(turn) * (1.0 - at_.sine * t));
  Leg leg = towards((at_.sine - t) / (1.0 - at_.sine * t), at_.cosine * shrink);
  leg.end_speed_mps = at_.speed_mps * shrink;
  leg.chord_m = std::sqrt(at_.speed_mps * leg.end_speed_mps) * time_s * sinh_over(0.5 * turn);
  leg.end_depth_m = at_.depth_m + leg.chord_m * leg.chord_sine;
  return leg;
}

double Path::length_of(const Leg& leg) const { return arc_m(curvature_pm(), leg.chord_m); }

double Path::time_of(const Leg& leg) const { return arc_s(gradient_, leg.chord_m, at_.speed_mps, leg.end_speed_mps); }

void Path::take(const Leg& leg) {
  at_.time_s += time_of(leg);
  at_.length_m += length_of(leg);
  // horizontal / invariant: chord cosine / invariant, with cosines = invariant * speed
  const double reach = leg.chord_m * leg.mean_scale * (at_.speed_mps + leg.end_speed_mps);
  at_.reach_m2ps += reach;
  at_.width_m += at_.width_slowness * reach;
  at_.depth_m = leg.end_depth_m;
  at_.speed_mps = leg.end_speed_mps;
  at_.sine = leg.end_sine;
  at_.cosine = leg.end_cosine;
  settle();
}

}  // namespace ensonify::refraction
