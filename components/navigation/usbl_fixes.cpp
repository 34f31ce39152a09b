#include "components/navigation/usbl_fixes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ensonify {

UsblFixes::UsblFixes(const UsblFixesConfig& config, Ports& ports) : config_(config) {
  ports.in<msg::UsblFix>("usbl_fix", [this](const msg::UsblFix& found) {
    if (found.valid) come_.push_back(found);
  });
}

void UsblFixes::correct(Estimator& estimator, const frames::LocalProjection& world) {
  if (!estimator.ready()) return;
  for (const msg::UsblFix& found : come_) {
    const double stamped_s = seconds(SimTime{found.stamp_ns});
    const double age_s = std::max(0.0, estimator.time_s() - stamped_s);
    estimator.correct(stamped_s, [fix = fix_of(found, estimator, world), age_s](Estimator::Filter& filter) {
      filter.correct_position(fix, age_s);
    });
  }
  come_.clear();
}

/// A small turn a about each axis moves what is at p by a sqrt(p^2 - p_i^2) along axis i; level axes of the other
/// vehicle are at any heading here, so that both get the mean of their variances.
Estimator::Filter::Fix UsblFixes::fix_of(const msg::UsblFix& found, const Estimator& estimator,
                                         const frames::LocalProjection& world) const {
  const frames::Vec3 place_m(found.place_body_m[0], found.place_body_m[1], found.place_body_m[2]);
  const double level2_m2 = place_m.head<2>().squaredNorm(), range2_m2 = place_m.squaredNorm();
  const double level_m = std::sqrt(0.5 * level2_m2);
  const auto turned_m = [&](double angle_rad) {
    const double across_m = angle_rad * std::sqrt(range2_m2 - 0.5 * level2_m2);
    return frames::Vec3(across_m, across_m, angle_rad * std::sqrt(level2_m2));
  };
  const frames::Vec3 slow_turn_m = turned_m(config_.attitude_rad), white_turn_m = turned_m(config_.attitude_white_rad);
  const frames::Vec3 stretch_m = config_.sound_speed_share * frames::Vec3(level_m, level_m, place_m.z());
  const frames::Vec3 array_ned_m(found.sigma_enu_m[1], found.sigma_enu_m[0], found.sigma_enu_m[2]);

  const frames::Geodetic place = world.geodetic_of({found.position_enu_m[0], found.position_enu_m[1]});
  constexpr double kDegree = std::numbers::pi / 180.0;
  Estimator::Filter::Fix fix;
  fix.latitude_rad = place.latitude_deg * kDegree;
  fix.longitude_rad = place.longitude_deg * kDegree;
  fix.height_m = found.position_enu_m[2];
  fix.lever_body_m = estimator.lever_of(config_.transponder_body_m);
  fix.sigma_ned_m = (array_ned_m.cwiseAbs2() + white_turn_m.cwiseAbs2()).cwiseSqrt().cwiseMax(1e-3);
  fix.wanders = false;
  fix.carrier_sigma_ned_m =
      (slow_turn_m.cwiseAbs2() + stretch_m.cwiseAbs2()).array() + config_.place_m * config_.place_m;
  fix.carrier_sigma_ned_m = fix.carrier_sigma_ned_m.cwiseSqrt().eval();
  return fix;
}

}  // namespace ensonify
