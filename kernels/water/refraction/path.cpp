#include "kernels/water/refraction/path.h"

#include <algorithm>

namespace ensonify::refraction {
namespace {

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

void Path::take(const Leg& leg) {
  at_ = end_of(leg);
  settle();
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

}  // namespace ensonify::refraction
