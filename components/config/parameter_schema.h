#pragma once

#include <string>

#include "components/config/parameter_info.h"

namespace ensonify {

/// A JSON Schema of one map with these keys, for a member that reads itself (ReadsItself).
std::string object_schema(const ParameterList& list);

}  // namespace ensonify
