#pragma once

#include <string>

namespace ensonify {

/// JSON Schema of scenario files, for editors: what every section may hold, with its sentence. What several keys say
/// together is checked by read_world() only.
std::string scenario_schema();

}  // namespace ensonify
