#include <array>
#include <catch2/catch.hpp>
#include <cmath>

#include "kernels/base/frames/pose.h"
#include "kernels/base/random/stream.h"
#include "kernels/survey/georeference/sounding.h"
#include "kernels/survey/uncertainty/sounding.h"

// Surveys made up without acoustics: soundings of a level bottom by an instrument all of whose sources err as they
// state, placed as instruments place them. Errors are held against what is predicted.

using namespace ensonify;
using namespace ensonify::uncertainty;
using Catch::WithinAbs;
using random::Stream;
using refraction::SoundSpeedProfile;

namespace {

constexpr double kDegree = M_PI / 180.0;
constexpr double kWater_mps = 1500.0, kDepth_m = 30.0;  // below the reference point at rest
const Vec3 kLever_m(1.5, 0.2, 0.8);

/// What a survey has wrong from beginning to end, and what goes in: about RTK, a fibre-optic gyro, a good cast.
const Sources kSources{.heave_m = 0.015,
                       .draught_m = 0.005,
                       .squat_m = 0.005,
                       .tide_m = 0.01,
                       .cast_mps = 0.25,
                       .face_mps = 0.1,
                       .lever_arm_m = {0.01, 0.01, 0.005},
                       .roll_rad = 0.01 * kDegree,
                       .pitch_rad = 0.03 * kDegree,
                       .yaw_rad = 0.03 * kDegree,
                       .position_latency_s = 0.004,
                       .attitude_latency_s = 0.001,
                       .along_rad = 0.1 * kDegree};
constexpr double kPosition_m = 0.02, kHeight_m = 0.015, kLevel_rad = 0.015 * kDegree, kHeading_rad = 0.04 * kDegree;

Navigation navigation() {
  Navigation n;
  n.position_enu_m2.diagonal() << kPosition_m * kPosition_m, kPosition_m * kPosition_m, kHeight_m * kHeight_m;
  n.rotation_enu_rad2.diagonal() << kLevel_rad * kLevel_rad, kLevel_rad * kLevel_rad, kHeading_rad * kHeading_rad;
  return n;
}

/// A boat that rolls, pitches and heaves on a course of 30 degrees.
struct Motion {
  Vec3 velocity(double t) const { return {4 * std::sin(0.52), 4 * std::cos(0.52), 0.2 * std::cos(t / 0.9)}; }
  frames::Pose pose(double t) const {
    frames::Pose pose;
    pose.position_enu_m = {velocity(t).x() * t, velocity(t).y() * t, 0.18 * std::sin(t / 0.9)};
    pose.enu_from_body = frames::enu_from_body({0.52, 1.5 * kDegree * std::sin(t * 1.3), 4 * kDegree * std::sin(t)});
    return pose;
  }
  Vec3 rate(double t) const {
    const frames::Quaternion turn = pose(t + 0.005).enu_from_body * pose(t - 0.005).enu_from_body.conjugate();
    return turn.vec() / 0.005;
  }
};

struct Share {
  int inside_vertical = 0, inside_horizontal = 0, all = 0;
};

/// Detection errs by this at a beam: amplitude near nadir, phase outwards; along the beam.
Detected detected(double angle_rad) { return {0.012, 0.03 * kDegree / std::cos(angle_rad)}; }

void survey(std::uint64_t seed, std::array<Share, 10>& by_angle) {
  const Stream drawn(seed, "uncertainty");
  const auto once = [&](std::uint64_t which) { return drawn.normal(which); };
  const Motion boat;
  const Sources& s = kSources;
  const frames::Quaternion mounting = Eigen::AngleAxisd(s.yaw_rad * once(3), Vec3::UnitZ()) *
                                      Eigen::AngleAxisd(s.pitch_rad * once(2), Vec3::UnitY()) *
                                      Eigen::AngleAxisd(s.roll_rad * once(1), Vec3::UnitX());
  const Vec3 lever =
      kLever_m + Vec3(s.lever_arm_m[0] * once(4), s.lever_arm_m[1] * once(5), s.lever_arm_m[2] * once(6));
  const double old_position_s = s.position_latency_s * once(7), old_attitude_s = s.attitude_latency_s * once(8);
  const double cast_mps = kWater_mps + s.cast_mps * once(9), face_mps = kWater_mps + s.face_mps * once(10);
  const double off_m = s.draught_m * once(11) + s.squat_m * once(12) + s.tide_m * once(13);
  constexpr int kPings = 60, kBeams = 80;
  for (std::uint64_t ping = 0; ping < kPings; ++ping) {
    const double t = 0.7 * static_cast<double>(ping);
    const auto now = [&](std::uint64_t which) { return drawn.normal(100 + which, ping); };
    const frames::Pose truth = boat.pose(t);
    const frames::HeadPose head = frames::head_pose(truth, {lever, mounting});
    frames::Pose stated = boat.pose(t - old_attitude_s);
    const Vec3 turn(kLevel_rad * now(0), kLevel_rad * now(1), kHeading_rad * now(2));
    stated.enu_from_body = Eigen::AngleAxisd(turn.norm(), turn.normalized()) * stated.enu_from_body;
    stated.position_enu_m.head<2>() = boat.pose(t - old_position_s).position_enu_m.head<2>();
    stated.position_enu_m +=
        Vec3(kPosition_m * now(3), kPosition_m * now(4), kHeight_m * now(5) + s.heave_m * now(6) + off_m);
    const frames::HeadPose estimated = frames::head_pose(stated, {kLever_m, frames::Quaternion::Identity()});
    for (std::uint64_t beam = 0; beam < kBeams; ++beam) {
      const double angle = (-65.0 + 130.0 * (static_cast<double>(beam) + 0.5) / kBeams) * kDegree;
      const double along = s.along_rad * drawn.normal(200, ping, beam);
      const Vec3 ray = head.enu_from_head *
                       Vec3(std::sin(along), std::cos(along) * std::sin(angle), std::cos(along) * std::cos(angle));
      const double range_m = (kDepth_m + head.position_enu_m.z()) / -ray.z();
      const Vec3 place = head.position_enu_m + range_m * ray;
      // What is heard: the sine across by delays in the true water, the time with what detection errs.
      const Detected sd = detected(angle);
      const double tan_vertical = std::hypot(ray.x(), ray.y()) / -ray.z();
      const double measured_m =
          range_m + std::hypot(sd.range_sd_m, range_m * tan_vertical * sd.angle_sd_rad) * drawn.normal(201, ping, beam);
      const Vec3 direction = georeference::intersect_cones(
          estimated.enu_from_head * Vec3::UnitX(), 0.0, estimated.enu_from_head * Vec3::UnitY(),
          std::cos(along) * std::sin(angle) * face_mps / kWater_mps, -Vec3::UnitZ());
      const frames::Quaternion enu_from_level = frames::enu_from_ned();
      const Vec3 away = enu_from_level * georeference::place_sounding({enu_from_level.conjugate() * direction,
                                                                       2 * measured_m / kWater_mps, 0.0, face_mps},
                                                                      SoundSpeedProfile::uniform(cast_mps));
      const Vec3 error = estimated.position_enu_m + away - place;
      const Matrix3 predicted = covariance_enu_m2({.away_enu_m = away,
                                                   .lever_enu_m = estimated.position_enu_m - stated.position_enu_m,
                                                   .enu_from_head = estimated.enu_from_head,
                                                   .velocity_enu_mps = boat.velocity(t),
                                                   .rate_enu_radps = boat.rate(t),
                                                   .sound_speed_mps = face_mps},
                                                  sd, navigation(), s);
      Share& share = by_angle[beam * by_angle.size() / kBeams];
      share.inside_vertical += std::abs(error.z()) <= tvu_m(predicted);
      share.inside_horizontal += error.head<2>().norm() <= thu_m(predicted);
      ++share.all;
    }
  }
}

}  // namespace

TEST_CASE("predicted intervals cover 93 to 97 % of true errors in every tenth of the swath") {
  // 50 surveys. What a survey has wrong from beginning to end is drawn 50 times only: where it is half the variance,
  // the share of a tenth scatters by about 1 %.
  std::array<Share, 10> by_angle;
  for (std::uint64_t seed = 1; seed <= 50; ++seed) survey(seed, by_angle);
  for (const Share& share : by_angle) {
    const double all = share.all;
    INFO("vertical " << share.inside_vertical / all << ", horizontal " << share.inside_horizontal / all);
    CHECK_THAT(share.inside_vertical / all, WithinAbs(0.95, 0.02));
    CHECK_THAT(share.inside_horizontal / all, WithinAbs(0.95, 0.02));
  }
}
