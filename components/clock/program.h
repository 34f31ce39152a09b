#pragma once

#include <map>
#include <string>

#include "launch/process/run.h"

namespace ensonify::clock {

/// main() of `ensonify-conductor`: the clock alone.
int clock_main(int argc, char** argv);

/// main() of `ensonify-host`: the clock, and in the same program the processes that `--host` names.
int host_main(int argc, char** argv, const std::map<std::string, NodeFactory>& components);

}  // namespace ensonify::clock
