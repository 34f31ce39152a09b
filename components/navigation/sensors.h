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

}  // namespace ensonify
