#pragma once

#include <string>
#include <vector>

namespace ensonify {

/// The known name that `name` was probably meant to be, or "" when none is close (a third of its letters may differ).
std::string nearest_name(const std::string& name, const std::vector<std::string>& known);

}  // namespace ensonify
