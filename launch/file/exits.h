#pragma once

#include <vector>

#include "launch/file/launch_file.h"

namespace ensonify {

/// Reads the entries `exit: ...` of the launch's list `expect:`, which must be a list, into launch.exits. Returns the
/// other entries. Precondition: the launch's processes are known.
std::vector<ConfigNode> read_exits(const ConfigReader& from, Launch& launch);

}  // namespace ensonify
