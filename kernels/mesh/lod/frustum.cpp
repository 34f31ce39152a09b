#include "kernels/mesh/lod/frustum.h"

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

/// Most of what is asked for lies far beside a thin fan. Sines differ by no more than their angles, a sphere hides less
/// than pi/2 x radius / distance of them to either side, and a launch is within twice the angle between the flattest
/// path and a level one of its chord.
bool far_beside(const Frustum& frustum, const Vec3& to_centre_m, double distance_m, double radius_m) {
  const Water& water = frustum.water;
  const double sine = to_centre_m.dot(frustum.axis_enu) / distance_m;
  const double beside = std::max(frustum.low_sine - sine, sine - frustum.high_sine) - 0.5 * pi * radius_m / distance_m;
  return beside > 0.0 && beside > 2.0 * std::acos(water.slowest_mps / water.fastest_mps);
}

double cosine_of(double sine) { return std::sqrt(std::max(0.0, 1.0 - sine * sine)); }

}  // namespace

PreparedFrustum::PreparedFrustum(const Frustum& frustum)
    : frustum_(frustum),
      straight_(frustum.water.slowest_mps == frustum.water.fastest_mps),
      low_rad_(std::asin(frustum.low_sine)),
      high_rad_(std::asin(frustum.high_sine)),
      half_rad_(0.5 * (frustum.high_angle_rad - frustum.low_angle_rad)),
      half_cosine_(std::cos(half_rad_)),
      half_sine_(std::sin(half_rad_)) {
  const double middle = 0.5 * (frustum.low_angle_rad + frustum.high_angle_rad);
  middle_enu_ = std::cos(middle) * frustum.zero_enu + std::sin(middle) * frustum.side_enu;
}

bool PreparedFrustum::intersects(const Sphere& sphere) const {
  const Vec3 to_centre_m = sphere.centre_enu_m - frustum_.apex_enu_m;
  const double distance_m = to_centre_m.norm();
  if (distance_m - sphere.radius_m > frustum_.max_range_m) return false;
  if (distance_m <= sphere.radius_m) return true;
  if (straight_) return straight_paths_intersect(to_centre_m / distance_m, sphere.radius_m / distance_m);
  return refracted_paths_intersect(to_centre_m, distance_m, sphere.radius_m);
}

/// By sines and cosines of sums of angles, for there are many spheres.
bool PreparedFrustum::straight_paths_intersect(const Vec3& direction, double around_sine) const {
  const double sine = direction.dot(frustum_.axis_enu), cosine = cosine_of(sine),
               around_cosine = cosine_of(around_sine);
  const double a = sine * around_cosine, b = cosine * around_sine;
  const double c = cosine * around_cosine, d = sine * around_sine;
  if (c - d > 0.0 && a + b < frustum_.low_sine) return false;   // cosine and sine of the greatest angle from the plane
  if (c + d > 0.0 && a - b > frustum_.high_sine) return false;  // of the least
  if (around_sine >= cosine || half_rad_ >= pi) return true;
  const double about_sine = around_sine / cosine, about_cosine = cosine_of(about_sine);
  const bool all_about = half_sine_ * about_cosine + half_cosine_ * about_sine <= 0.0;  // half a circle to either side
  return all_about || direction.dot(middle_enu_) >= cosine * (half_cosine_ * about_cosine - half_sine_ * about_sine);
}

bool PreparedFrustum::refracted_paths_intersect(const Vec3& to_centre_m, double distance_m, double radius_m) const {
  if (far_beside(frustum_, to_centre_m, distance_m, radius_m)) return false;
  const Swept swept = launched_towards(frustum_, to_centre_m, radius_m);
  const double around = swept.around_rad;
  if (around >= 0.5 * pi) return true;
  const auto [low_sine, high_sine] = sines_of(swept, frustum_.axis_enu);
  const double low = std::asin(std::clamp(low_sine, -1.0, 1.0)), high = std::asin(std::clamp(high_sine, -1.0, 1.0));
  if (high + around < low_rad_ || low - around > high_rad_) return false;
  const double nearest_axis = std::cos(std::max(std::abs(low), std::abs(high))), sine = std::sin(around);
  if (sine >= nearest_axis) return true;
  const Interval about = angles_of(frustum_, swept);
  const double between = 0.5 * (about.low + about.high - frustum_.low_angle_rad - frustum_.high_angle_rad);
  const double halves = 0.5 * (about.high - about.low) + half_rad_;
  return std::abs(std::remainder(between, 2.0 * pi)) <= halves + std::asin(sine / nearest_axis);
}

}  // namespace ensonify::lod
