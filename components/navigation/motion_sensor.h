#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "components/navigation/instrument_config.h"
#include "messages/motion.h"
#include "messages/navigation.h"

namespace ensonify {

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
