#pragma once

#include <string>

#include "components/config/parameters.h"
#include "kernels/survey/spacing.h"
#include "scenarios/world/world.h"

namespace ensonify {

class ConfigReader;

struct CoverageParameters {
  std::string vehicle;
  int rate_hz = 1;
  double head_depth_m = 0.0;
  double cost_per_day = 0.0;
  double cube_step_m = 0.25;

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("vehicle", "", any(), "vehicle of the scenario; \"\": the one with the process's name, or the only one",
          self.vehicle);
    visit("rate_hz", "Hz", in(1, 10), "rate of coverage messages", self.rate_hz);
    visit("head_depth_m", "m", in(-10, 11000),
          "depth of the transducer below chart datum: swaths are counted from there", self.head_depth_m);
    visit("cost_per_day", "", in(0, 1e12), "cost of 24 h, in any currency", self.cost_per_day);
    visit("cube_step_m", "m", in(0.01, 100),
          "step in which soundings are counted to give the smallest cube that is found; at most 32 million cells",
          self.cube_step_m);
  }
};

struct CoverageConfig : CoverageParameters {
  // From the scenario.
  AdaptivePlan plan;
  survey::RunRules run;  // how lines at a fixed distance would be run, and what running costs

  static CoverageConfig read(ConfigReader& from, const World& world, const std::string& process);
};

}  // namespace ensonify
