#pragma once

#include <string>

#include "components/config/config_node.h"

namespace ensonify {

/// Compact JSON with the types that YAML 1.2 gives to plain scalars (null, true, false, numbers).
std::string to_json(const ConfigNode& node);

/// YAML in one fixed layout without places, for records: equal trees give equal bytes. A scalar that is an absolute
/// path is reduced to its last part, so no record knows on which machine it was made.
std::string to_canonical_yaml(const ConfigNode& node);

}  // namespace ensonify
