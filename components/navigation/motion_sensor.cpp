#include "components/navigation/motion_sensor.h"

#include "components/navigation/world_frame.h"
#include "components/runtime/sim_time.h"
#include "kernels/base/frames/attitude.h"

namespace ensonify {
namespace {

constexpr double kDelayedStep_s = 0.2;

}  // namespace

MotionSensor::MotionSensor(const MotionSensorConfig& config, std::uint64_t seed, const std::string& process)
    : config_(config),
      roll_(config.angle, {seed, process + "/motion_sensor/roll"}),
      pitch_(config.angle, {seed, process + "/motion_sensor/pitch"}),
      heave_error_(config.heave_error, {seed, process + "/motion_sensor/heave"}),
      level_(config.level),
      heave_(config.heave) {
  if (config.delayed_heave_s > 0.0) {
    window_ = sensors::delayed_heave_window(config.heave.cutoff_s, config.delayed_heave_s, kDelayedStep_s);
  }
}

msg::Attitude MotionSensor::measure(const msg::Pose& pose) {
  const frames::MovingPose truth = moving_pose(pose);
  const double dt_s = last_ns_ ? seconds(SimTime{pose.stamp_ns - *last_ns_}) : 0.0;
  last_ns_ = pose.stamp_ns;

  // A turn to starboard at speed v and rate r is an acceleration v r to starboard.
  const double turn_radps = -(truth.pose.enu_from_body * truth.angular_rate_body_radps).z();
  const double across_mps2 = truth.velocity_enu_mps.head<2>().norm() * turn_radps;
  const double lean_rad = level_.advance(across_mps2, dt_s);

  const frames::Mounting &actual = config_.instrument.actual, &measured = config_.instrument.measured;
  const frames::Quaternion estimated =
      truth.pose.enu_from_body * actual.body_from_head * measured.body_from_head.conjugate();
  const frames::Attitude angles = frames::attitude_of(estimated);
  msg::Attitude attitude;
  attitude.roll_rad = roll_.measure(angles.roll_rad, dt_s) + lean_rad;
  attitude.pitch_rad = pitch_.measure(angles.pitch_rad, dt_s);

  // Vertical motion is measured where the sensor is, and carried to the point of heave by its own angles.
  const frames::Attitude reported{angles.heading_rad, attitude.pitch_rad, attitude.roll_rad};
  const frames::Vec3 to_point = config_.heave_point_body_m - measured.position_body_m;
  const double height_m =
      frames::enu_from_body(truth.pose, actual.position_body_m).z() + (frames::enu_from_body(reported) * to_point).z();
  const double heave_m = heave_.measure(height_m, level_.vertical_error_mps2(across_mps2), dt_s);
  attitude.heave_m = heave_error_.measure(heave_m, dt_s);
  attitude.stamp_ns = pose.stamp_ns;
  if (!window_.empty()) remember(pose.stamp_ns, height_m);
  return attitude;
}

void MotionSensor::remember(std::int64_t stamp_ns, double height_m) {
  if (!stamps_ns_.empty() && stamp_ns - stamps_ns_.back() < from_seconds(kDelayedStep_s).count()) return;
  heights_m_.push_back(height_m);
  stamps_ns_.push_back(stamp_ns);
  fresh_ = true;
  if (heights_m_.size() > window_.size()) heights_m_.pop_front(), stamps_ns_.pop_front();
}

std::optional<msg::DelayedHeave> MotionSensor::delayed_heave() {
  if (!fresh_ || heights_m_.size() < window_.size()) return std::nullopt;
  fresh_ = false;
  const std::vector<double> heights(heights_m_.begin(), heights_m_.end());
  msg::DelayedHeave delayed;
  delayed.stamp_ns = stamps_ns_[stamps_ns_.size() / 2];
  delayed.heave_m = sensors::delayed_heave_m(heights, window_);
  return delayed;
}

}  // namespace ensonify
