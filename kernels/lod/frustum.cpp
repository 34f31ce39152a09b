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

double angle_of(const Frustum& frustum, const Vec3& direction) {
  return std::atan2(direction.dot(frustum.side_enu), direction.dot(frustum.zero_enu));
}

/// Angles about the axis of the swept directions themselves.
Interval angles_of(const Frustum& frustum, const Swept& swept) {
  const double first = angle_of(frustum, swept.at(swept.depression_rad.low));
  const double last = angle_of(frustum, swept.at(swept.depression_rad.high));
  const double turn = std::remainder(last - first, 2.0 * pi);  // of less than half a circle
  return {std::min(first, first + turn), std::max(first, first + turn)};
}

/// Whether directions, and all within an angle of one of them, are partly the frustum's. `angles()`: about the axis.
template <class Angles>
bool overlap(const Frustum& frustum, const Interval& from_plane_rad, double around_rad, const Angles& angles) {
  const auto [low, high] = from_plane_rad;
  if (high + around_rad < std::asin(frustum.low_sine) || low - around_rad > std::asin(frustum.high_sine)) return false;
  const double nearest_axis = std::cos(std::max(std::abs(low), std::abs(high))), sine = std::sin(around_rad);
  if (sine >= nearest_axis) return true;
  const Interval about = angles();
  const double between = 0.5 * (about.low + about.high - frustum.low_angle_rad - frustum.high_angle_rad);
  const double halves = 0.5 * (about.high - about.low + frustum.high_angle_rad - frustum.low_angle_rad);
  return std::abs(std::remainder(between, 2.0 * pi)) <= halves + std::asin(sine / nearest_axis);
}

/// Most of what is asked for lies far beside a thin fan. Sines differ by no more than their angles, a sphere hides less
/// than pi/2 x radius / distance of them to either side, and a launch is within twice the angle between the flattest
/// path and a level one of its chord.
bool far_beside(const Frustum& frustum, const Vec3& to_centre_m, double distance_m, double radius_m) {
  const Water& water = frustum.water;
  const double sine = to_centre_m.dot(frustum.axis_enu) / distance_m;
  const double beside = std::max(frustum.low_sine - sine, sine - frustum.high_sine) - 0.5 * pi * radius_m / distance_m;
  if (beside <= 0.0) return false;
  return water.slowest_mps == water.fastest_mps || beside > 2.0 * std::acos(water.slowest_mps / water.fastest_mps);
}

}  // namespace

bool meets(const Frustum& frustum, const Sphere& sphere) {
  const Vec3 to_centre_m = sphere.centre_enu_m - frustum.apex_enu_m;
  const double distance_m = to_centre_m.norm();
  if (distance_m - sphere.radius_m > frustum.max_range_m) return false;
  if (distance_m <= sphere.radius_m) return true;
  if (far_beside(frustum, to_centre_m, distance_m, sphere.radius_m)) return false;
  const auto angle_from_plane = [](double sine) { return std::asin(std::clamp(sine, -1.0, 1.0)); };
  if (frustum.water.slowest_mps == frustum.water.fastest_mps) {  // as below, with one direction
    const Vec3 direction = to_centre_m / distance_m;
    const double from_plane = angle_from_plane(direction.dot(frustum.axis_enu));
    return overlap(frustum, {from_plane, from_plane}, std::asin(sphere.radius_m / distance_m), [&] {
      const double angle = angle_of(frustum, direction);
      return Interval{angle, angle};
    });
  }
  const Swept swept = launched_towards(frustum, to_centre_m, sphere.radius_m);
  if (swept.around_rad >= 0.5 * pi) return true;
  const auto [low, high] = sines_of(swept, frustum.axis_enu);
  return overlap(frustum, {angle_from_plane(low), angle_from_plane(high)}, swept.around_rad,
                 [&] { return angles_of(frustum, swept); });
}

}  // namespace ensonify::lod
