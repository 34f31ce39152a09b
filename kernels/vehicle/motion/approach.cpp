#include "kernels/vehicle/motion/approach.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ensonify::motion {
namespace {

constexpr double kThere = 1e-9;  // closer than this to a path is on it

/// Uniform acceleration for a time.
struct Phase {
  double acceleration;
  double duration_s;
};

/// At once at full speed, and at once at rest.
Moving without_inertia(const Moving& from, double target, double dt_s, double fastest) {
  const double way = target - from.value, reach = fastest * dt_s;
  return {std::abs(way) <= reach ? target : from.value + std::copysign(reach, way), 0.0, 0.0};
}

std::array<Phase, 3> plan(const Moving& from, double target, double fastest, double a) {
  const double way = target - from.value, w = from.rate;
  const double spare = way - w * std::abs(w) / (2.0 * a);  // to the target from where braking now would end
  if (std::abs(spare) <= kThere) return {{{w > 0.0 ? -a : a, std::abs(w) / a}, {0.0, 0.0}, {0.0, 0.0}}};

  // With `side` pointing to the target from the stopping point, all of this is a way upwards.
  const double side = std::copysign(1.0, spare), v = side * w, d = side * way;
  const double peak = std::min(fastest, std::sqrt(std::max(0.0, a * d + 0.5 * v * v)));
  const double first = peak >= v ? a : -a;
  const double gained = (peak * peak - v * v) / (2.0 * first), braked = peak * peak / (2.0 * a);
  const double cruise_s = peak > 0.0 ? std::max(0.0, (d - gained - braked) / peak) : 0.0;
  return {{{side * first, (peak - v) / first}, {0.0, cruise_s}, {-side * a, peak / a}}};
}

}  // namespace

Moving approach(const Moving& from, double target, double dt_s, double fastest, double acceleration) {
  if (std::isinf(acceleration)) return without_inertia(from, target, dt_s, fastest);
  Moving now{from.value, from.rate, 0.0};
  double left_s = dt_s;
  for (const Phase& phase : plan(from, target, fastest, acceleration)) {
    const double t = std::min(left_s, phase.duration_s);
    now.value += (now.rate + 0.5 * phase.acceleration * t) * t;
    now.rate += phase.acceleration * t;
    now.acceleration = phase.acceleration;
    left_s -= t;
    if (t < phase.duration_s) return now;
  }
  return {target, 0.0, 0.0};
}

}  // namespace ensonify::motion
