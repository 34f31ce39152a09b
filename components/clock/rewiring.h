#pragma once

#include <string>
#include <vector>

#include "components/runtime/wiring.h"

namespace ensonify::clock {

/// What the wiring of a later epoch asks for that the sockets of the first were not made for, a line each; none: it can
/// run in the same processes. Topics and who reads them must be the same. Rates, delays and sizes may differ, sizes up
/// to what a line carries.
std::vector<std::string> rewired(const Graph& first, const std::vector<Declaration>& first_processes, const Graph& now,
                                 const std::vector<Declaration>& processes);

}  // namespace ensonify::clock
