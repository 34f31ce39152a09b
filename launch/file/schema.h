#pragma once

#include <map>
#include <string>

namespace ensonify {

/// JSON Schema of launch files, for editors. `components` has the JSON Schema of each component's parameters by its
/// name; others' `config` may hold anything. Every value may be an argument, $(name).
std::string launch_schema(const std::map<std::string, std::string>& components);

}  // namespace ensonify
