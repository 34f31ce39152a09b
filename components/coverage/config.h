#pragma once

#include <string>

#include "components/runtime/config/scenario.h"

namespace ensonify {

class ConfigReader;

struct CoverageConfig {
  int rate_hz = 1;
  double head_depth_m = 0.0;  // of the transducer below chart datum

  // From the scenario.
  AdaptivePlan plan;

  static CoverageConfig read(ConfigReader& from, const Scenario& scenario, const std::string& process);
  /// The parameters of its own, which default.yaml lists.
  bool operator==(const CoverageConfig& other) const {
    return rate_hz == other.rate_hz && head_depth_m == other.head_depth_m;
  }
};

}  // namespace ensonify
