#pragma once

#include <string>

#include "components/config/parameters.h"
#include "scenarios/world/world.h"

namespace ensonify {

class ConfigReader;

struct AutopilotParameters {
  std::string vehicle;
  int command_rate_hz = 10;
  double lookahead_radii = 1.5;
  double turn_margin = 1.2;
  double turn_speed_fraction = 1.0;
  double drift_settle_s = 10.0;
  double patience_s = 600.0;
  bool giving_up_fails = true;

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("vehicle", "", any(), "vehicle of the scenario; \"\": the one with the process's name, or the only one",
          self.vehicle);
    visit("command_rate_hz", "Hz", in(1, 100), "commands published per second", self.command_rate_hz);
    visit("lookahead_radii", "", in(0.2, 20),
          "line-of-sight distance in turning radii, of at least 2 s of way; smaller steers harder",
          self.lookahead_radii);
    visit("turn_margin", "", in(1, 10), "planned turns are this much wider than the vehicle's turning circle",
          self.turn_margin);
    visit("turn_speed_fraction", "", in(0.1, 1), "speed in turns, of the mission's", self.turn_speed_fraction);
    visit("drift_settle_s", "s", in(0, 1000),
          "time constant with which the drift is estimated; 0: none, and lines are held without an integral",
          self.drift_settle_s);
    visit("patience_s", "s", in(0, 1e6),
          "a mission whose vehicle comes no metre nearer to its goal for so long is given up; 0: never",
          self.patience_s);
    visit("given_up", "", one_of({{"fail", true}, {"end", false}}),
          "fail: a run whose mission is given up ends with exit code 1; end: with 0, as if the mission were done",
          self.giving_up_fails);
  }
};

struct AutopilotConfig : AutopilotParameters {
  // From the scenario.
  MissionPlan plan;

  static AutopilotConfig read(ConfigReader& from, const World& world, const std::string& process);
};

}  // namespace ensonify
