#include "components/runtime/config/own_vehicle.h"

#include <algorithm>

#include "components/runtime/config/config_reader.h"

namespace ensonify {

Vehicle own_vehicle(ConfigReader& from, const Scenario& scenario, const std::string& process) {
  std::string wanted, names;
  from.optional("vehicle", wanted);
  const auto find = [&](const std::string& name) {
    return std::find_if(scenario.vehicles.begin(), scenario.vehicles.end(),
                        [&](const Vehicle& vehicle) { return vehicle.name == name; });
  };
  if (const auto found = find(wanted.empty() ? process : wanted); found != scenario.vehicles.end()) return *found;
  if (wanted.empty() && scenario.vehicles.size() == 1) return scenario.vehicles.front();

  for (const Vehicle& vehicle : scenario.vehicles) names += (names.empty() ? "" : ", ") + vehicle.name;
  if (scenario.vehicles.empty()) {
    from.problem("vehicle", "the scenario " + scenario.file + " has no vehicle");
  } else if (wanted.empty()) {
    from.problem("vehicle", "is missing, and no vehicle is named " + process + "; allowed: " + names);
  } else {
    from.problem("vehicle", "\"" + wanted + "\" is no vehicle of the scenario; allowed: " + names);
  }
  return {};
}

}  // namespace ensonify
