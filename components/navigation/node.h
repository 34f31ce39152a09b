#pragma once

#include <deque>
#include <optional>
#include <utility>

#include "components/navigation/estimator.h"
#include "components/navigation/motion_sensor.h"
#include "components/navigation/sensors.h"
#include "components/navigation/suite.h"
#include "components/runtime/ports.h"

namespace ensonify {

class NavigationNode {
 public:
  using Config = NavigationConfig;
  static constexpr const char* kComponent = "navigation";

  NavigationNode(const Config& config, Ports& ports);

  SimTime step(SimTime now);

 private:
  msg::Pose moved() const;
  void measure_position(std::int64_t n);
  void take_fix(const msg::Position& position);
  void measure_attitude(SimTime now, std::int64_t n);
  void report_sound_speed(SimTime now);
  void find_transponder(SimTime now);
  void report_trouble();
  void estimate(const msg::Attitude& attitude);
  void update_pose(const msg::Estimate& estimate);

  Ports& ports_;
  NavigationSensors sensors_;
  DeadReckoning filter_;
  Periodic imu_due_, attitude_due_, position_due_, sound_speed_due_;
  SimTime motion_latency_, sound_speed_latency_;
  OutputAge output_age_;
  std::deque<std::pair<SimTime, msg::SoundSpeed>> sound_speeds_under_way_;
  std::optional<frames::LocalProjection> world_;
  std::optional<msg::Pose> truth_;
  std::deque<msg::Pose> recent_;  // the newest pose that is as old as the motion sensor's latency, and all after it
  EstimatedPose estimated_pose_;  // as last measured or estimated
  Outbox outbox_;
  Ports::Out<msg::Attitude> attitudes_;
  Ports::Out<msg::Position> positions_;
  Ports::Out<msg::SoundSpeed> sound_speeds_;
  Ports::Out<msg::Estimate> estimates_;
  std::optional<Ports::Out<msg::InertialIncrements>> increments_;
  std::optional<Ports::Out<msg::DelayedHeave>> delayed_heaves_;
  Instruments carried_;
  std::optional<MotionSensor> motion_sensor_;
  std::optional<Estimator> estimator_;
  Suite suite_;
  std::optional<UsblTracker> usbl_;
  std::optional<UsblFixes> usbl_fixes_;
  std::optional<double> low_antenna_m_;  // above the water at rest, if that is too low for fixes
  bool afloat_;
};

}  // namespace ensonify
