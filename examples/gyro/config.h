#pragma once

#include <cstdint>
#include <string>

#include "components/config/parameters.h"
#include "scenarios/scenario_file.h"

namespace ensonify {

class ConfigReader;

struct GyroParameters {
  int rate_hz = 10;
  double bias_rad = 0.5 * 3.14159265358979323846 / 180.0;
  double sigma_rad = 0.1 * 3.14159265358979323846 / 180.0;

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("rate_hz", "Hz", in(1, 1000), "headings published per second", self.rate_hz);
    visit("bias_deg", "deg", in(-180, 180), "constant error of the heading", self.bias_rad);
    visit("sigma_deg", "deg", in(0, 90), "standard deviation of white noise, each sample on its own", self.sigma_rad);
  }
};

struct GyroConfig : GyroParameters {
  // From the scenario.
  std::uint64_t seed = 1;
  std::string process;

  static GyroConfig read(ConfigReader& from, const ScenarioHeader& scenario, const std::string& process);
};

}  // namespace ensonify
