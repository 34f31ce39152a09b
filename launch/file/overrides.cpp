#include "launch/file/overrides.h"

#include <algorithm>

#include "components/errors/nearest_name.h"
#include "launch/file/tree.h"

namespace ensonify {
namespace {

const std::vector<std::string> kScenarioSections = {"site", "time", "seed", "water", "seabed", "vehicles", "mission"};

}  // namespace

bool is_scenario_section(const std::string& name) {
  return std::find(kScenarioSections.begin(), kScenarioSections.end(), name) != kScenarioSections.end();
}

Overrides overrides_of(const ConfigNode& root, const std::vector<std::string>& sets,
                       std::vector<ConfigProblem>& problems) {
  Overrides overrides;
  if (const ConfigNode* set = root.find("set")) {
    for (const auto& entry : set->entries) {
      overrides.emplace_back(entry.key, entry.value);
    }
    if (!set->is_map() && !set->is_null()) {
      problems.push_back({set->place, "set", "is not a map from PROCESS.KEY to a value"});
    }
  }
  for (const auto& text : sets) {
    const auto assignment = split_assignment(text);
    const ConfigPlace place{"--set " + (assignment ? assignment->first : text)};
    if (!assignment) {
      problems.push_back({place, "", "is not KEY=VALUE"});
      continue;
    }
    try {
      overrides.emplace_back(assignment->first, parse_config_value(assignment->second, place));
    } catch (const ConfigError& error) {
      problems.insert(problems.end(), error.problems().begin(), error.problems().end());
    }
  }
  return overrides;
}

OverrideTargets sort_overrides(const Overrides& overrides, const ConfigNode& root,
                               std::vector<ConfigProblem>& problems) {
  std::vector<std::string> known = kScenarioSections;
  known.emplace_back("clock");
  const ConfigNode* processes = root.find("processes");
  if (processes != nullptr) {
    for (const auto& entry : processes->entries) {
      known.push_back(entry.key);
    }
  }
  OverrideTargets targets;
  for (const auto& [path, value] : overrides) {
    const std::size_t dot = path.find('.');
    const std::string first = path.substr(0, dot);
    const std::string rest = dot == std::string::npos ? "" : path.substr(dot + 1);
    if (is_scenario_section(first)) {
      targets.scenario.emplace_back(path, value);
    } else if (rest.empty() && std::find(known.begin(), known.end(), first) != known.end()) {
      problems.push_back({value.place, "set." + path, "names no key of " + first + "; allowed: " + first + ".KEY"});
    } else if (first == "clock") {
      targets.clock.emplace_back(rest, value);
    } else if (processes != nullptr && processes->find(first) != nullptr) {
      targets.processes[first].emplace_back(rest, value);
    } else {
      const std::string nearest = nearest_name(first, known);
      problems.push_back(
          {value.place, "set." + path,
           "names no process, scenario section or clock" + (nearest.empty() ? "" : "; did you mean " + nearest + "?")});
    }
  }
  return targets;
}

}  // namespace ensonify
