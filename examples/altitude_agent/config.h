#pragma once

#include <string>

#include "components/config/parameters.h"
#include "scenarios/scenario_file.h"

namespace ensonify {

class ConfigReader;

struct AltitudeAgentParameters {
  int rate_hz = 10;
  double altitude_m = 6.0;
  double gain = 1.0;
  double speed_mps = 1.5;
  double heading_rad = 0.0;

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("rate_hz", "Hz", in(1, 100), "commands published per second", self.rate_hz);
    visit("altitude_m", "m", in(1, 100), "altitude to keep", self.altitude_m);
    visit("gain", "", in(0.01, 10), "change of the ordered depth over the error of altitude", self.gain);
    visit("speed_mps", "m/s", in(0, 10), "speed to order", self.speed_mps);
    visit("heading_deg", "deg", in(-360, 360), "heading to order", self.heading_rad);
  }
};

struct AltitudeAgentConfig : AltitudeAgentParameters {
  static AltitudeAgentConfig read(ConfigReader& from, const ScenarioHeader& scenario, const std::string& process);
};

}  // namespace ensonify
