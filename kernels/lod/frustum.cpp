#include "kernels/lod/frustum.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ensonify::lod {
namespace {

using frames::Vec3;
using std::numbers::pi;

struct Interval {
  double low, high;
};

/// Directions of one azimuth between two depressions, and all that are within an angle of one of them.
struct Swept {
  Vec3 level_enu;  // unit, horizontal, at the azimuth
  Interval depression_rad;
  double around_rad;

  Vec3 at(double depression) const { return std::cos(depression) * level_enu - std::sin(depression) * Vec3::UnitZ(); }
};

/// Snell: cos(depression) / speed is the same all along a path, and a chord is no flatter than the flattest and no
/// steeper than the steepest part of it.
double steepest_launch(const Water& water, double chord_rad) {
  return std::copysign(std::acos(std::cos(chord_rad) * water.at_head_mps / water.fastest_mps), chord_rad);
}
double flattest_launch(const Water& water, double chord_rad) {
  const double cosine = std::min(1.0, std::cos(chord_rad) * water.at_head_mps / water.slowest_mps);
  return std::copysign(std::acos(cosine), chord_rad);
}

/// Depressions at which paths leave the head whose chords have these.
Interval launches(const Water& water, const Interval& chords) {
  Interval all{chords.low >= 0.0 ? flattest_launch(water, chords.low) : steepest_launch(water, chords.low),
               chords.high >= 0.0 ? steepest_launch(water, chords.high) : flattest_launch(water, chords.high)};
  // A path that turns is level somewhere: it starts flatter than `turning`, and its chord is flatter than `turned`.
  const double turned = std::acos(water.slowest_mps / water.fastest_mps);
  if (chords.low <= turned && chords.high >= -turned) {
    const double turning = std::acos(water.at_head_mps / water.fastest_mps);
    all = {std::min(all.low, -turning), std::max(all.high, turning)};
  }
  return all;
}

/// Directions in which paths leave the apex that touch the sphere, which does not hold the apex.
Swept launched_towards(const Frustum& frustum, const Vec3& to_centre_m, double radius_m) {
  const double distance_m = to_centre_m.norm(), level_m = to_centre_m.head<2>().norm();
  const double depression = std::asin(std::clamp(-to_centre_m.z() / distance_m, -1.0, 1.0));
  const double around = std::asin(std::min(1.0, radius_m / distance_m));
  Swept swept{level_m > 0.0 ? Vec3(to_centre_m.x() / level_m, to_centre_m.y() / level_m, 0.0) : Vec3::UnitX(),
              {depression, depression},
              around};
  const Water& water = frustum.water;
  if (water.slowest_mps == water.fastest_mps) return swept;
  const Interval chords{std::max(depression - around, -0.5 * pi), std::min(depression + around, 0.5 * pi)};
  const Interval all = launches(water, chords);
  // Either all directions within what a path bends at most, best where it is steep and bends little ...
  swept.around_rad += std::max(chords.low - all.low, all.high - chords.high);
  if (radius_m >= level_m) return swept;
  // ... or the depressions apart from the azimuths, which do not bend.
  const double flattest = all.low > 0.0 ? all.low : all.high < 0.0 ? all.high : 0.0;
  const double in_azimuth = std::asin(radius_m / level_m) * std::cos(flattest);
  if (in_azimuth < swept.around_rad) {
    swept.depression_rad = all;
    swept.around_rad = in_azimuth;
  }
  return swept;
}

/// Of the cosine with an axis, over the swept directions themselves: it is a cosine of the depression.
Interval sines_of(const Swept& swept, const Vec3& axis) {
  const double level = swept.level_enu.dot(axis), greatest = std::hypot(level, axis.z());
  const double at = std::atan2(-axis.z(), level), other = at > 0.0 ? at - pi : at + pi;
  const auto [low, high] = swept.depression_rad;
  const double a = swept.at(low).dot(axis), b = swept.at(high).dot(axis);
  return {low < other && other < high ? -greatest : std::min(a, b), low < at && at < high ? greatest : std::max(a, b)};
}

bool angles_overlap(const Frustum& frustum, const Swept& swept, double around_axis_rad) {
  const auto angle = [&](double depression) {
    const Vec3 direction = swept.at(depression);
    return std::atan2(direction.dot(frustum.side_enu), direction.dot(frustum.zero_enu));
  };
  const double first = angle(swept.depression_rad.low);
  const double turn = std::remainder(angle(swept.depression_rad.high) - first, 2.0 * pi);  // of less than half a circle
  const double middle = first + 0.5 * turn, half = 0.5 * std::abs(turn) + around_axis_rad;
  const double frustum_middle = 0.5 * (frustum.low_angle_rad + frustum.high_angle_rad);
  const double frustum_half = 0.5 * (frustum.high_angle_rad - frustum.low_angle_rad);
  return std::abs(std::remainder(middle - frustum_middle, 2.0 * pi)) <= half + frustum_half;
}

}  // namespace

bool meets(const Frustum& frustum, const Sphere& sphere) {
  const Vec3 to_centre_m = sphere.centre_enu_m - frustum.apex_enu_m;
  const double distance_m = to_centre_m.norm();
  if (distance_m - sphere.radius_m > frustum.max_range_m) return false;
  if (distance_m <= sphere.radius_m) return true;
  const Swept swept = launched_towards(frustum, to_centre_m, sphere.radius_m);
  if (swept.around_rad >= 0.5 * pi) return true;
  const auto [low, high] = sines_of(swept, frustum.axis_enu);
  const double low_rad = std::asin(std::clamp(low, -1.0, 1.0)), high_rad = std::asin(std::clamp(high, -1.0, 1.0));
  if (high_rad + swept.around_rad < std::asin(frustum.low_sine)) return false;
  if (low_rad - swept.around_rad > std::asin(frustum.high_sine)) return false;
  const double nearest_axis = std::cos(std::max(std::abs(low_rad), std::abs(high_rad)));
  const double sine = std::sin(swept.around_rad);
  if (sine >= nearest_axis) return true;
  return angles_overlap(frustum, swept, std::asin(sine / nearest_axis));
}

}  // namespace ensonify::lod
