#pragma once

#include <map>
#include <string>
#include <vector>

#include "components/config/config_error.h"

namespace ensonify::pager {

/// Places in a scenario's file of what is run, for messages. What the launch file has changed stands nowhere there, and
/// has the file alone.
struct MissionPlaces {
  ConfigPlace mission;
  std::vector<ConfigPlace> steps;             // of each; lines laid out by a rule have that of the rule, once
  std::map<std::string, ConfigPlace> starts;  // by vehicle

  const ConfigPlace& step(std::size_t i) const;
  const ConfigPlace& start(const std::string& vehicle) const;
};

/// Reads `scenario_file` again, if it is there and `scenario_text`, the scenario in force in its canonical form, is
/// not empty.
MissionPlaces mission_places(const std::string& scenario_file, const std::string& scenario_text);

}  // namespace ensonify::pager
