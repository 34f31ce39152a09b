#pragma once

#include <string>

#include "scenarios/world/world.h"

namespace ensonify {

/// The vehicle that a process belongs to: the one that its configuration names under `vehicle` (`wanted`), else the one
/// that has the process's name, else the scenario's only one. Anything else is a problem of `from`, and the result a
/// default.
Vehicle own_vehicle(const ConfigReader& from, const World& world, const std::string& process,
                    const std::string& wanted);

}  // namespace ensonify
