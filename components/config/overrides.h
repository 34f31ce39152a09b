#pragma once

#include <string>
#include <utility>
#include <vector>

#include "components/config/config_error.h"
#include "components/config/config_node.h"

namespace ensonify {

/// Values to set before reading: ("water.salinity_psu", value). Their places appear in messages.
using Overrides = std::vector<std::pair<std::string, ConfigNode>>;

/// Applies overrides to a tree; a path that leads nowhere is a problem.
std::vector<ConfigProblem> apply(const Overrides& overrides, ConfigNode& root);

}  // namespace ensonify
