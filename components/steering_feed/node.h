#pragma once

#include <optional>

#include "components/runtime/ports.h"
#include "components/steering_feed/config.h"
#include "components/steering_feed/ordered_course.h"
#include "components/transport/receiver.h"
#include "messages/motion.h"
#include "messages/navigation.h"
#include "messages/terrain.h"

namespace ensonify {

/// Steers as a survey package or a plotter orders by NMEA sentences.
class SteeringFeedNode {
 public:
  using Config = SteeringFeedConfig;
  static constexpr const char* kComponent = "steering_feed";

  SteeringFeedNode(const Config& config, Ports& ports);

  SimTime step(SimTime now);

 private:
  void listen();
  void receive(SimTime now);
  double heading_grid_rad(const OrderedCourse::Order& order) const;

  Config config_;
  Ports& ports_;
  Periodic commands_due_;
  std::optional<Receiver> receiver_;              // from the first event on: a check of the launch file takes no port
  std::optional<frames::LocalProjection> world_;  // from when its origin is known on
  std::optional<msg::Estimate> estimate_;
  OrderedCourse course_;
  frames::Vec2 drift_enu_mps_ = frames::Vec2::Zero();  // of the water, as far as it is across the heading
  std::uint64_t refused_ = 0, dropped_bytes_ = 0;      // counted already
  Ports::Out<msg::Guidance> commands_;
};

}  // namespace ensonify
