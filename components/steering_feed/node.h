#pragma once

#include <optional>
#include <vector>

#include "components/feeds/feed_input.h"
#include "components/feeds/lines.h"
#include "components/runtime/ports.h"
#include "components/steering_feed/config.h"
#include "components/steering_feed/ordered_course.h"
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
  void receive(SimTime now);
  double heading_grid_rad(const OrderedCourse::Order& order) const;

  Config config_;
  Ports& ports_;
  Periodic commands_due_;
  std::optional<frames::LocalProjection> world_;  // from when its origin is known on
  std::optional<msg::Estimate> estimate_;
  OrderedCourse course_;
  frames::Vec2 drift_enu_mps_ = frames::Vec2::Zero();  // of the water, as far as it is across the heading
  Ports::Out<msg::Guidance> commands_;
  FeedInput input_;
  std::vector<Lines> lines_;  // of each source
};

}  // namespace ensonify
