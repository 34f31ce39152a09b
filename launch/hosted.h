#pragma once

#include <set>
#include <string>

#include "launch/file/launch_file.h"

namespace ensonify::launcher {

/// Processes that `ensonify run --hosted` puts into the clock's program: our own components, but for those that have
/// files to complete, that the launch file gives something of their own (processors, memory, environment, an ending)
/// or that may be lost. These need a process of their own.
std::set<std::string> hosted_processes(const Launch& launch);

}  // namespace ensonify::launcher
