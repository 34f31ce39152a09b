#pragma once

#include <string>

#include "components/runtime/config/launch_file.h"

namespace ensonify {

/// Launch::launch_text of a launch whose `$(out)` has not been put in yet.
std::string canonical_text(const Launch& launch);

}  // namespace ensonify
