#include "components/navigation/sensors.h"

#include <cmath>

#include "components/navigation/world_frame.h"
#include "kernels/base/frames/attitude.h"

namespace ensonify {
namespace {

double noise(const random::Stream& stream, std::int64_t n, std::uint64_t axis) {
  return stream.normal(static_cast<std::uint64_t>(n), axis);
}

}  // namespace

NavigationSensors::NavigationSensors(const NavigationConfig& config)
    : sigma_(config.sigma),
      heights_(config.heights),
      probe_(config.probe),
      water_(config.water),
      attitude_noise_(config.seed, config.process + "/attitude"),
      position_noise_(config.seed, config.process + "/position"),
      velocity_noise_(config.seed, config.process + "/velocity"),
      sound_speed_noise_(config.seed, config.process + "/sound_speed") {}

msg::Attitude NavigationSensors::attitude(const msg::Pose& truth, std::int64_t n) const {
  const frames::Attitude angles = frames::attitude_of(frames::quaternion_of(truth.enu_from_body));
  msg::Attitude measured;
  measured.stamp_ns = truth.stamp_ns;
  measured.roll_rad = angles.roll_rad + sigma_.roll_rad * noise(attitude_noise_, n, 0);
  measured.pitch_rad = angles.pitch_rad + sigma_.pitch_rad * noise(attitude_noise_, n, 1);
  measured.heading_grid_rad =
      frames::wrap_two_pi(angles.heading_rad + sigma_.heading_rad * noise(attitude_noise_, n, 2));
  measured.heave_m = truth.position_enu_m[2] - heights_.mean_m(truth) + sigma_.heave_m * noise(attitude_noise_, n, 3);
  return measured;
}

msg::Position NavigationSensors::position(const msg::Pose& truth, std::int64_t n,
                                          const frames::LocalProjection& world) const {
  msg::Position measured;
  measured.stamp_ns = truth.stamp_ns;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double sigma_m = axis < 2 ? sigma_.horizontal_m : sigma_.vertical_m;
    measured.position_enu_m[axis] = truth.position_enu_m[axis] + sigma_m * noise(position_noise_, n, axis);
  }
  report_position(measured, world, heights_.datums);
  measured.sigma_horizontal_m = sigma_.horizontal_m;
  measured.sigma_vertical_m = sigma_.vertical_m;
  return measured;
}

frames::Vec3 NavigationSensors::velocity_enu_mps(const msg::Pose& truth, std::int64_t n) const {
  frames::Vec3 measured;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    measured[static_cast<Eigen::Index>(axis)] =
        truth.velocity_enu_mps[axis] + sigma_.velocity_mps * noise(velocity_noise_, n, axis);
  }
  return measured;
}

msg::SoundSpeed NavigationSensors::sound_speed(const msg::Pose& truth, std::int64_t n) const {
  msg::SoundSpeed measured;
  measured.stamp_ns = truth.stamp_ns;
  const auto& [forward_m, starboard_m, down_m] = probe_.position_body_m;
  const frames::Vec3 offset_enu_m =
      frames::quaternion_of(truth.enu_from_body) * frames::Vec3(forward_m, starboard_m, down_m);
  const double depth_m = -(truth.position_enu_m[2] + offset_enu_m.z());
  measured.sound_speed_mps =
      water_.sound_speed.speed_mps(depth_m) + probe_.bias_mps + probe_.sigma_mps * noise(sound_speed_noise_, n, 0);
  return measured;
}

}  // namespace ensonify
