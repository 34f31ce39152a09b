#pragma once

#include <string>

#include "kernels/survey/cost.h"
#include "scenarios/world/world.h"

namespace ensonify {

class ConfigReader;

struct CoverageConfig {
  int rate_hz = 1;
  double head_depth_m = 0.0;  // of the transducer below chart datum
  double cost_per_day = 0.0;  // any currency, of 24 h
  double cube_step_m = 0.25;  // how finely soundings are counted to give the smallest cube that is found

  // From the scenario.
  AdaptivePlan plan;
  survey::RunRules run;  // how lines at a fixed distance would be run, and what running costs

  static CoverageConfig read(ConfigReader& from, const World& world, const std::string& process);
  /// The parameters of its own, which default.yaml lists.
  bool operator==(const CoverageConfig& other) const {
    return rate_hz == other.rate_hz && head_depth_m == other.head_depth_m && cost_per_day == other.cost_per_day &&
           cube_step_m == other.cube_step_m;
  }
};

}  // namespace ensonify
