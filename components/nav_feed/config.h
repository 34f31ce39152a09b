#pragma once

#include <optional>
#include <string>

#include "components/runtime/config/scenario.h"

namespace ensonify {

class ConfigReader;

struct NavFeedConfig {
  int port = 10110;        // UDP, on the loopback interface
  int pose_rate_hz = 100;  // how often the true pose is published
  double delay_s = 2.5;    // of the vehicle behind the feed; two intervals between fixes and more make its way smooth
  double fastest_mps = 30.0;  // fixes that ask for more are not believed

  // From the scenario.
  std::optional<frames::Geodetic> origin;  // not given: the chart tells it
  vertical::Tide tide;
  motion::Current current;
  std::optional<vertical::Loading> floats;

  static NavFeedConfig read(ConfigReader& from, const Scenario& scenario, const std::string& process);
  /// The parameters of its own, which default.yaml lists.
  bool operator==(const NavFeedConfig& other) const {
    return port == other.port && pose_rate_hz == other.pose_rate_hz && delay_s == other.delay_s &&
           fastest_mps == other.fastest_mps;
  }
};

}  // namespace ensonify
