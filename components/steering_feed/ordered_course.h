#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "components/formats/nmea/steering.h"
#include "components/runtime/sim_time.h"
#include "components/steering_feed/config.h"

namespace ensonify {

/// What sentences order: a heading, or the course that leads onto their leg. The newest sentence counts.
class OrderedCourse {
 public:
  using Count = std::function<void(const std::string& what)>;

  /// `count` is told of every sentence what became of it.
  OrderedCourse(const SteeringFeedConfig& config, Count count);

  /// A datagram: one sentence or more.
  void take(std::string_view text, SimTime now);

  struct Order {
    double true_rad = 0.0;    // clockwise from true north
    bool is_heading = false;  // else the course to make good
  };
  /// What to steer at `now`; once every 1 / command_rate_hz. Nothing while no sentence counts.
  std::optional<Order> order(SimTime now, double speed_mps);

 private:
  struct Leg {
    double true_bearing_rad = 0.0;
    double off_m = 0.0;
  };

  void take(const nmea::HeadingOrder& order, SimTime now);
  void take(const nmea::LegOrder& order, SimTime now);
  std::optional<double> true_rad(const nmea::Bearing& bearing);
  void follow(double true_bearing_rad, double off_m, SimTime now);

  SteeringFeedConfig config_;
  Count count_;
  std::optional<double> heading_rad_;  // ordered, in the place of a leg
  std::optional<Leg> leg_;
  double integral_s_ = 0.0;
  SimTime taken_at_{0};
};

}  // namespace ensonify
