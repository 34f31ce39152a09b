#include "kernels/motion/climb.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ensonify::motion {
namespace {

constexpr double kThere_m = 1e-9;  // closer than this to a path is on it

/// Uniform acceleration for a time.
struct Phase {
  double acceleration_mps2;
  double duration_s;
};

/// At once at full speed, and at once at rest.
Climb without_inertia(const Climb& from, double target_m, double dt_s, double fastest_mps) {
  const double way_m = target_m - from.height_m, reach_m = fastest_mps * dt_s;
  return {std::abs(way_m) <= reach_m ? target_m : from.height_m + std::copysign(reach_m, way_m), 0.0, 0.0};
}

std::array<Phase, 3> plan(const Climb& from, double target_m, double fastest_mps, double a) {
  const double way_m = target_m - from.height_m, w = from.speed_mps;
  const double spare_m = way_m - w * std::abs(w) / (2.0 * a);  // to the target from where braking now would end
  if (std::abs(spare_m) <= kThere_m) return {{{w > 0.0 ? -a : a, std::abs(w) / a}, {0.0, 0.0}, {0.0, 0.0}}};

  // With `side` pointing to the target from the stopping point, all of this is a climb upwards.
  const double side = std::copysign(1.0, spare_m), v = side * w, d = side * way_m;
  const double peak = std::min(fastest_mps, std::sqrt(std::max(0.0, a * d + 0.5 * v * v)));
  const double first = peak >= v ? a : -a;
  const double gained_m = (peak * peak - v * v) / (2.0 * first), braked_m = peak * peak / (2.0 * a);
  const double cruise_s = peak > 0.0 ? std::max(0.0, (d - gained_m - braked_m) / peak) : 0.0;
  return {{{side * first, (peak - v) / first}, {0.0, cruise_s}, {-side * a, peak / a}}};
}

}  // namespace

Climb climb(const Climb& from, double target_m, double dt_s, double fastest_mps, double acceleration_mps2) {
  if (std::isinf(acceleration_mps2)) return without_inertia(from, target_m, dt_s, fastest_mps);
  Climb now{from.height_m, from.speed_mps, 0.0};
  double left_s = dt_s;
  for (const Phase& phase : plan(from, target_m, fastest_mps, acceleration_mps2)) {
    const double t = std::min(left_s, phase.duration_s);
    now.height_m += (now.speed_mps + 0.5 * phase.acceleration_mps2 * t) * t;
    now.speed_mps += phase.acceleration_mps2 * t;
    now.acceleration_mps2 = phase.acceleration_mps2;
    left_s -= t;
    if (t < phase.duration_s) return now;
  }
  return {target_m, 0.0, 0.0};
}

}  // namespace ensonify::motion
