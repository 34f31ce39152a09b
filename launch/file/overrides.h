#pragma once

#include <map>
#include <string>
#include <vector>

#include "components/config/overrides.h"

namespace ensonify {

/// Overrides sorted by what they change.
struct OverrideTargets {
  std::map<std::string, Overrides> processes;  // paths within the process's parameters
  Overrides scenario;                          // paths from the scenario's root
  Overrides clock;
};

/// Overrides of the file's own `set:`, then of --set, in the order in which they count.
Overrides overrides_of(const ConfigNode& root, const std::vector<std::string>& sets,
                       std::vector<ConfigProblem>& problems);

/// Sorts by the first key of each path: a scenario section, `clock`, or a process of `root`.
OverrideTargets sort_overrides(const Overrides& overrides, const ConfigNode& root,
                               std::vector<ConfigProblem>& problems);

bool is_scenario_section(const std::string& name);

}  // namespace ensonify
