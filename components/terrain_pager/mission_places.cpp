#include "components/terrain_pager/mission_places.h"

#include <algorithm>
#include <filesystem>

#include "components/config/config_node.h"
#include "components/config/data_paths.h"

namespace ensonify::pager {
namespace {

/// A value of the file, if it is in force: a launch file may have put another in its place.
const ConfigNode* in_force(const ConfigNode* of_file, const ConfigNode* in_run) {
  const bool same =
      of_file != nullptr && in_run != nullptr && to_canonical_yaml(*of_file) == to_canonical_yaml(*in_run);
  return same ? of_file : nullptr;
}

/// The keys of a mission may stand in a file of their own.
void find_steps(const ConfigNode& keys, const std::string& file, std::vector<ConfigPlace>& steps) {
  for (const char* list : {"runlines", "steps"}) {
    const ConfigNode* found = keys.find(list);
    for (std::size_t i = 0; found != nullptr && i < found->items.size(); ++i) steps.push_back(found->items[i].place);
  }
  for (const char* rule : {"lawnmower", "adaptive", "auto"}) {
    if (const ConfigNode* found = keys.find(rule)) steps.push_back(found->place);
  }
  const ConfigNode* own = keys.find("file");
  if (!steps.empty() || own == nullptr || !own->is_scalar()) return;
  const std::string path = find_data(own->scalar, {std::filesystem::path(file).parent_path().string()});
  if (!path.empty()) find_steps(parse_config_file(path).root, path, steps);
}

}  // namespace

const ConfigPlace& MissionPlaces::step(std::size_t i) const {
  return steps.empty() ? mission : steps[std::min(i, steps.size() - 1)];
}

const ConfigPlace& MissionPlaces::start(const std::string& vehicle) const {
  const auto found = starts.find(vehicle);
  return found == starts.end() ? mission : found->second;
}

MissionPlaces mission_places(const std::string& scenario_file, const std::string& scenario_text) {
  MissionPlaces places{{scenario_file, 0, 0}, {}, {}};
  if (scenario_text.empty() || !std::filesystem::is_regular_file(scenario_file)) return places;
  const ConfigNode file = parse_config_file(scenario_file).root;
  const ConfigNode run = parse_config(scenario_text, scenario_file).root;
  if (const ConfigNode* vehicles = file.find("vehicles"); vehicles != nullptr && run.find("vehicles") != nullptr) {
    for (const auto& vehicle : vehicles->entries) {
      const ConfigNode* steered = run.find("vehicles")->find(vehicle.key);
      const ConfigNode* start = in_force(vehicle.value.find("start"), steered ? steered->find("start") : nullptr);
      places.starts[vehicle.key] = start != nullptr ? start->place : places.mission;
    }
  }
  if (const ConfigNode* mission = in_force(file.find("mission"), run.find("mission"))) {
    places.mission = mission->place;
    find_steps(*mission, scenario_file, places.steps);
  }
  return places;
}

}  // namespace ensonify::pager
