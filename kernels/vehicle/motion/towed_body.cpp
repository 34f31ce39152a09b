#include "kernels/vehicle/motion/towed_body.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace ensonify::motion {
namespace {

constexpr double kDensity_kgpm3 = 1025.0;
constexpr int kElements = 200;

void check(const TowCable& cable, const TowedBody& body, double speed_mps) {
  const bool good = cable.out_m > 0.0 && cable.diameter_m > 0.0 && cable.weight_npm >= 0.0 &&
                    cable.normal_drag >= 0.0 && cable.tangential_drag >= 0.0 && body.weight_n > 0.0 &&
                    body.drag_area_m2 >= 0.0 && speed_mps >= 0.0 && std::isfinite(speed_mps);
  if (!good) {
    throw std::invalid_argument(
        "towed body: cable out, diameter and the body's weight must be above 0; drags, cable weight and speed 0 or "
        "more");
  }
}

/// Tension and slope of the cable (above the horizontal, forward), and where it is from the body.
struct Element {
  double tension_n, slope_rad, height_m, ahead_m;
};

}  // namespace

TowShape tow_shape(const TowCable& cable, const TowedBody& body, double speed_mps) {
  check(cable, body, speed_mps);
  const double pressure = 0.5 * kDensity_kgpm3 * speed_mps * speed_mps;
  const double drag_n = pressure * body.drag_area_m2;
  const auto rate = [&](const Element& e) {
    const double s = std::sin(e.slope_rad), c = std::cos(e.slope_rad);
    const double normal_npm = pressure * cable.normal_drag * cable.diameter_m * s * std::abs(s);
    const double along_npm = pressure * cable.tangential_drag * std::numbers::pi * cable.diameter_m * c * std::abs(c);
    return Element{cable.weight_npm * s + along_npm, (cable.weight_npm * c - normal_npm) / e.tension_n, s, c};
  };
  const auto moved = [](const Element& e, const Element& d, double h) {
    return Element{e.tension_n + h * d.tension_n, e.slope_rad + h * d.slope_rad, e.height_m + h * d.height_m,
                   e.ahead_m + h * d.ahead_m};
  };
  Element e{std::hypot(drag_n, body.weight_n), std::atan2(body.weight_n, drag_n), 0.0, 0.0};
  const double h = cable.out_m / kElements;
  for (int i = 0; i < kElements; ++i) {  // the midpoint rule
    e = moved(e, rate(moved(e, rate(e), 0.5 * h)), h);
  }
  return {e.height_m, e.ahead_m, e.tension_n};
}

TowState towed_behind(const TowCable& cable, const TowedBody& body, const frames::Vec3& sheave_enu_m,
                      double heading_rad, double speed_mps) {
  const TowShape shape = tow_shape(cable, body, speed_mps);
  const frames::Vec3 back(-std::sin(heading_rad), -std::cos(heading_rad), 0.0);
  return {sheave_enu_m + shape.layback_m * back - shape.depth_m * frames::Vec3::UnitZ(),
          frames::wrap_two_pi(heading_rad), speed_mps, shape.layback_m};
}

TowState tow(const TowCable& cable, const TowedBody& body, const TowState& state, const frames::Vec3& sheave_enu_m,
             const frames::Vec2& current_enu_mps, double lag_s, double dt_s) {
  const TowShape shape = tow_shape(cable, body, state.speed_mps);
  const frames::Vec2 drifted = state.position_enu_m.head<2>() + dt_s * current_enu_mps;
  const frames::Vec2 to_sheave = sheave_enu_m.head<2>() - drifted;
  const double distance_m = to_sheave.norm(), fall = -std::expm1(-dt_s / lag_s);

  TowState next = state;
  next.layback_m += fall * (shape.layback_m - state.layback_m);
  const double pulled_m = std::max(0.0, distance_m - next.layback_m);
  next.position_enu_m.head<2>() = drifted;
  if (distance_m > 1e-6) {
    next.position_enu_m.head<2>() += pulled_m / distance_m * to_sheave;
    next.heading_rad = frames::wrap_two_pi(std::atan2(to_sheave.x(), to_sheave.y()));
  }
  next.speed_mps += fall * (pulled_m / dt_s - state.speed_mps);
  next.position_enu_m.z() += fall * (sheave_enu_m.z() - shape.depth_m - state.position_enu_m.z());
  return next;
}

}  // namespace ensonify::motion
