#include "kernels/vehicle/motion/current.h"

#include <algorithm>
#include <cmath>

#include "kernels/vehicle/motion/excursion.h"

namespace ensonify::motion {
namespace {

using frames::Vec2;
using Profile = std::vector<Current::Knot>;

Vec2 mean_shear_ps(const Current::Knot& above, const Current::Knot& below) {
  return (below.velocity_enu_mps - above.velocity_enu_mps) / (below.depth_m - above.depth_m);
}

/// Shear at a knot: a weighted harmonic mean of those above and below [Fritsch1984, eq. 5].
Vec2 knot_shear_ps(const Profile& profile, std::size_t i) {
  Vec2 shear = Vec2::Zero();
  if (i == 0 || i + 1 == profile.size()) return shear;
  const double above_m = profile[i].depth_m - profile[i - 1].depth_m;
  const double below_m = profile[i + 1].depth_m - profile[i].depth_m;
  const Vec2 above = mean_shear_ps(profile[i - 1], profile[i]), below = mean_shear_ps(profile[i], profile[i + 1]);
  for (const int axis : {0, 1}) {
    if (above(axis) * below(axis) <= 0.0) continue;  // it turns here
    const double weights = (above_m + 2.0 * below_m) / above(axis) + (2.0 * above_m + below_m) / below(axis);
    shear(axis) = 3.0 * (above_m + below_m) / weights;
  }
  return shear;
}

struct Steady {
  Vec2 velocity_enu_mps = Vec2::Zero();
  Vec2 shear_ps = Vec2::Zero();  // its derivative by depth
};

Steady steady(const Profile& profile, double depth_m) {
  if (profile.empty()) return {};
  const auto below =
      std::find_if(profile.begin(), profile.end(), [&](const Current::Knot& knot) { return depth_m <= knot.depth_m; });
  if (below == profile.begin()) return {profile.front().velocity_enu_mps, Vec2::Zero()};
  if (below == profile.end()) return {profile.back().velocity_enu_mps, Vec2::Zero()};
  const auto i = static_cast<std::size_t>(below - profile.begin());
  const Current::Knot& above = profile[i - 1];
  const Vec2 from = knot_shear_ps(profile, i - 1), to = knot_shear_ps(profile, i);
  Steady at;
  for (const int axis : {0, 1}) {
    const Moving moving =
        cubic_between({above.velocity_enu_mps(axis), from(axis)}, {below->velocity_enu_mps(axis), to(axis)},
                      below->depth_m - above.depth_m, depth_m - above.depth_m);
    at.velocity_enu_mps(axis) = moving.value;
    at.shear_ps(axis) = moving.rate;
  }
  return at;
}

}  // namespace

Vec2 Current::velocity_enu_mps(double depth_m, double t_s) const {
  Vec2 velocity = steady(profile, depth_m).velocity_enu_mps;
  for (const Stream& stream : streams) {
    velocity += std::cos(stream.speed_radps * t_s - stream.phase_rad) * stream.amplitude_enu_mps;
  }
  return velocity;
}

Vec2 Current::acceleration_enu_mps2(double depth_m, double sinking_mps, double t_s) const {
  Vec2 acceleration = Vec2::Zero();
  for (const Stream& stream : streams) {
    acceleration -=
        stream.speed_radps * std::sin(stream.speed_radps * t_s - stream.phase_rad) * stream.amplitude_enu_mps;
  }
  return acceleration + sinking_mps * steady(profile, depth_m).shear_ps;
}

Vec2 Current::drift_enu_m(double depth_m, double t_s, double dt_s) const {
  Vec2 drift = dt_s * steady(profile, depth_m).velocity_enu_mps;
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
