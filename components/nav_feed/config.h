#pragma once

#include <optional>
#include <string>

#include "scenarios/world/world.h"

namespace ensonify {

class ConfigReader;

struct NavFeedConfig {
  enum class Height {
    kWater,  // the water level of the scenario, less what the hull settles by, plus the feed's heave
    kGga,    // GGA's heights, between fixes by the feed's heave
  };

  int port = 10110;        // UDP, on the loopback interface
  int pose_rate_hz = 100;  // how often the true pose is published
  double delay_s = 2.5;    // of the vehicle behind the feed; two intervals between fixes and more make its way smooth
  double fastest_mps = 30.0;                           // fixes that ask for more are not accepted
  frames::Vec3 antenna_body_m = frames::Vec3::Zero();  // the place that GGA is of
  Height height = Height::kWater;

  // From the scenario.
  std::optional<frames::Geodetic> origin;  // not given: the chart gives it
  vertical::Tide tide;
  motion::Current current;
  vertical::Datums datums;
  std::optional<vertical::Loading> floats;

  static NavFeedConfig read(ConfigReader& from, const World& world, const std::string& process);
  /// The parameters of its own, which default.yaml lists.
  bool operator==(const NavFeedConfig& other) const {
    return port == other.port && pose_rate_hz == other.pose_rate_hz && delay_s == other.delay_s &&
           fastest_mps == other.fastest_mps && antenna_body_m == other.antenna_body_m && height == other.height;
  }
};

}  // namespace ensonify
