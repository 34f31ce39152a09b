#pragma once

#include <limits>
#include <optional>

#include "components/config/parameters.h"
#include "scenarios/world/world.h"

namespace ensonify {

class ConfigReader;

struct SteeringFeedParameters {
  int port = 10111;
  int command_rate_hz = 10;
  double speed_mps = 2.0;
  std::optional<double> depth_m;
  double valid_s = 3.0;
  double lookahead_m = 20.0;
  std::optional<double> variation_rad;

  static void parameters(auto& self, auto&& visit) {
    visit("port", "", in(1024, 65535), "UDP port on the loopback interface", self.port);
    visit("command_rate_hz", "Hz", in(1, 100), "commands published per second, while sentences come",
          self.command_rate_hz);
    visit("speed_mps", "m/s", in(0, 100), "speed through the water to order; the sentences have none", self.speed_mps);
    visit("depth_m", "m", in(0, 11000), "depth to order; left out: as before", self.depth_m);
    visit("valid_s", "s", in(0.1, 60), "time of sim time for which the newest sentence counts", self.valid_s);
    visit("lookahead_m", "m", in(1, 1000), "line-of-sight distance on the leg; smaller steers harder",
          self.lookahead_m);
    visit("variation_deg", "deg", in(-180, 180),
          "magnetic variation, east positive; left out: magnetic bearings are not taken", self.variation_rad);
  }
};

struct SteeringFeedConfig : SteeringFeedParameters {
  std::optional<frames::Geodetic> origin;  // from the scenario; not given: the chart gives it

  static SteeringFeedConfig read(ConfigReader& from, const World& world, const std::string& process);
};

}  // namespace ensonify
