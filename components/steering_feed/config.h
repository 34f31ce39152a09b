#pragma once

#include <optional>
#include <vector>

#include "components/config/parameters.h"
#include "components/feeds/byte_source.h"
#include "scenarios/world/world.h"

namespace ensonify {

class ConfigReader;

struct SteeringFeedParameters {
  std::vector<ByteSource> sources{{.name = "package", .way = ByteSource::Udp{10111}}};
  bool recorded = false;
  int command_rate_hz = 10;
  double speed_mps = 2.0;
  std::optional<double> depth_m;
  double valid_s = 3.0;
  double lookahead_m = 20.0;
  std::optional<double> variation_rad;

  static void parameters(auto& self, auto&& visit) {
    visit("sources", "sources of sentences, by names of your own", self.sources);
    visit("recorded", "", any(),
          "record in place of the sources: the input `data` brings what another run took of them", self.recorded);
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
  void check(const ConfigReader& from) const;
};

struct SteeringFeedConfig : SteeringFeedParameters {
  std::optional<frames::Geodetic> origin;  // from the scenario; not given: the chart gives it

  static SteeringFeedConfig read(ConfigReader& from, const World& world, const std::string& process);
};

}  // namespace ensonify
