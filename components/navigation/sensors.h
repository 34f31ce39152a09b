#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "components/navigation/config.h"
#include "components/navigation/instrument_config.h"
#include "components/runtime/sim_time.h"
#include "kernels/base/random/stream.h"
#include "messages/motion.h"
#include "messages/navigation.h"

namespace ensonify {

/// Attitude, position and velocity sensors at the body's origin: truth plus white Gaussian noise, without bias; and a
/// sound speed probe. Latency is the node's business. Sample n of a sensor is a pure function of (seed, process, n) and
/// the truth.
class NavigationSensors {
 public:
  explicit NavigationSensors(const NavigationConfig& config);

  msg::Attitude attitude(const msg::Pose& truth, std::int64_t n) const;
  /// Latitude and longitude are those of the noisy place.
  msg::Position position(const msg::Pose& truth, std::int64_t n, const frames::LocalProjection& world) const;
  frames::Vec3 velocity_enu_mps(const msg::Pose& truth, std::int64_t n) const;
  /// Sound speed of the water at the probe's depth; above chart datum that of the topmost water.
  msg::SoundSpeed sound_speed(const msg::Pose& truth, std::int64_t n) const;

 private:
  NavigationErrors sigma_;
  Heights heights_;
  SoundSpeedProbe probe_;
  TrueWater water_;
  random::Stream attitude_noise_, position_noise_, velocity_noise_, sound_speed_noise_;
};

/// Roll, pitch and heave as a motion sensor finds them. Heading is not its business.
class MotionSensor {
 public:
  MotionSensor(const MotionSensorConfig& config, std::uint64_t seed, const std::string& process);

  /// From the true pose. Heading of the result is zero.
  msg::Attitude measure(const msg::Pose& truth);

  /// Delayed heave, when a new one is known.
  std::optional<msg::DelayedHeave> delayed_heave();

 private:
  void remember(std::int64_t stamp_ns, double height_m);

  MotionSensorConfig config_;
  sensors::ScalarSensor roll_, pitch_, heave_error_;
  sensors::LevelError level_;
  sensors::HeaveFilter heave_;
  std::optional<std::int64_t> last_ns_;
  std::vector<double> window_;
  std::deque<double> heights_m_;  // of every kDelayedStep, the newest last
  std::deque<std::int64_t> stamps_ns_;
  bool fresh_ = false;  // a height has come that no delayed heave has been made of
};

}  // namespace ensonify
