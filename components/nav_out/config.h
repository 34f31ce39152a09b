#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "components/config/parameters.h"
#include "components/nav_out/output.h"
#include "kernels/base/frames/local_projection.h"
#include "scenarios/world/world.h"

namespace ensonify {

class ConfigReader;

/// The transponders of AIS.
struct AisParameters {
  int mmsi = 200'000'001;
  std::vector<std::string> poses;

  static void parameters(auto& self, auto&& visit) {
    visit("mmsi", "", in(1, 999'000'000),
          "identity that the own vessel's reports state; those of others count on from it, in the order of their names",
          self.mmsi);
    visit("poses", "", any(),
          "vehicles without navigation, by the processes that move them: they report where they truly are", self.poses);
  }
};

struct NavOutParameters {
  std::vector<Output> outputs{Output{}};
  AisParameters ais;
  int step_rate_hz = 100;

  static void parameters(auto& self, auto&& visit) {
    visit("outputs", "the receivers, by names of your own", self.outputs);
    visit("ais", "transponders that VDO and VDM report of", self.ais);
    visit("step_rate_hz", "Hz", in(1, 1000),
          "times per second at which instruments' messages are taken and sentences leave", self.step_rate_hz);
  }
};

struct NavOutConfig : NavOutParameters {
  // From the scenario.
  std::optional<frames::Geodetic> origin;  // not given: the chart gives it
  std::int64_t start_unix_ns = 0;

  static NavOutConfig read(ConfigReader& from, const World& world, const std::string& process);
};

}  // namespace ensonify
