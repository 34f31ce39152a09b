#pragma once

#include <string>

#include "launch/file/launch_file.h"

namespace ensonify {

/// Launch::launch_text of a launch whose `$(out)` has not been put in yet.
std::string canonical_text(const Launch& launch);

}  // namespace ensonify
