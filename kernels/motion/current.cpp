#include "kernels/motion/current.h"

#include <cmath>

namespace ensonify::motion {
namespace {

frames::Vec2 steady(const std::vector<Current::Knot>& profile, double depth_m) {
  if (profile.empty()) return frames::Vec2::Zero();
  if (depth_m <= profile.front().depth_m) return profile.front().velocity_enu_mps;
  for (std::size_t i = 1; i < profile.size(); ++i) {
    const Current::Knot &above = profile[i - 1], &below = profile[i];
    if (depth_m > below.depth_m) continue;
    const double share = (depth_m - above.depth_m) / (below.depth_m - above.depth_m);
    return above.velocity_enu_mps + share * (below.velocity_enu_mps - above.velocity_enu_mps);
  }
  return profile.back().velocity_enu_mps;
}

}  // namespace

frames::Vec2 Current::velocity_enu_mps(double depth_m, double t_s) const {
  frames::Vec2 velocity = steady(profile, depth_m);
  for (const Stream& stream : streams) {
    velocity += std::cos(stream.speed_radps * t_s - stream.phase_rad) * stream.amplitude_enu_mps;
  }
  return velocity;
}

frames::Vec2 Current::acceleration_enu_mps2(double t_s) const {
  frames::Vec2 acceleration = frames::Vec2::Zero();
  for (const Stream& stream : streams) {
    acceleration -=
        stream.speed_radps * std::sin(stream.speed_radps * t_s - stream.phase_rad) * stream.amplitude_enu_mps;
  }
  return acceleration;
}

frames::Vec2 Current::drift_enu_m(double depth_m, double t_s, double dt_s) const {
  frames::Vec2 drift = dt_s * steady(profile, depth_m);
  for (const Stream& stream : streams) {
    // sin b - sin a as 2 cos((a + b) / 2) sin((b - a) / 2): exact for short steps of slow tides.
    const double half = 0.5 * stream.speed_radps * dt_s;
    const double middle = stream.speed_radps * t_s - stream.phase_rad + half;
    const double seconds = half == 0.0 ? dt_s : dt_s * std::sin(half) / half;
    drift += seconds * std::cos(middle) * stream.amplitude_enu_mps;
  }
  return drift;
}

}  // namespace ensonify::motion
