#pragma once

#include <map>
#include <string>
#include <vector>

#include "components/config/config_node.h"
#include "components/config/parse_yaml.h"
#include "launch/file/launch_file.h"

namespace ensonify {

/// The launch file with its includes merged (theirs first) and its arguments put in; `$(out)` is left for later.
/// Problems found on the way are in the document.
ConfigDocument load_launch_tree(const std::string& file, const std::vector<std::string>& args);

/// Replaces `$(name)` in every scalar by `values`; names in `later` stay. Unknown names are problems.
void substitute(ConfigNode& node, const std::map<std::string, ConfigNode>& values,
                const std::vector<std::string>& later, std::vector<ConfigProblem>& problems);

/// Splits "a.b=v" at its first "="; nothing when there is none or the left side is empty.
std::optional<std::pair<std::string, std::string>> split_assignment(const std::string& text);

/// Overrides sorted by what they change.
struct OverrideTargets {
  std::map<std::string, Overrides> processes;  // paths within the process's parameters
  Overrides scenario;                          // paths from the scenario's root
  Overrides clock;
  Overrides launch;  // of the launch file itself
};

/// Overrides of the file's own `set:`, then of --set, in the order in which they count.
Overrides overrides_of(const ConfigNode& root, const std::vector<std::string>& sets,
                       std::vector<ConfigProblem>& problems);

/// Sorts by the first key of each path: a scenario section, `clock`, or a process of `root`.
OverrideTargets sort_overrides(const Overrides& overrides, const ConfigNode& root,
                               std::vector<ConfigProblem>& problems);

bool is_scenario_section(const std::string& name);

}  // namespace ensonify
