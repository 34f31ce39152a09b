#include "scenarios/world/own_vehicle.h"

#include <algorithm>

#include "components/config/config_reader.h"

namespace ensonify {

Vehicle own_vehicle(const ConfigReader& from, const World& world, const std::string& process,
                    const std::string& wanted) {
  std::string names;
  const auto find = [&](const std::string& name) {
    return std::find_if(world.vehicles.begin(), world.vehicles.end(),
                        [&](const Vehicle& vehicle) { return vehicle.name == name; });
  };
  if (const auto found = find(wanted.empty() ? process : wanted); found != world.vehicles.end()) return *found;
  if (wanted.empty() && world.vehicles.size() == 1) return world.vehicles.front();

  for (const Vehicle& vehicle : world.vehicles) names += (names.empty() ? "" : ", ") + vehicle.name;
  if (world.vehicles.empty()) {
    from.problem("vehicle", "the scenario " + world.file + " has no vehicle");
  } else if (wanted.empty()) {
    from.problem("vehicle", "is missing, and no vehicle is named " + process + "; allowed: " + names);
  } else {
    from.problem("vehicle", "\"" + wanted + "\" is no vehicle of the scenario; allowed: " + names);
  }
  return {};
}

}  // namespace ensonify
