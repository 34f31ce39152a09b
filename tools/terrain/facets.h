#pragma once

#include "components/runtime/config/scenario.h"

namespace ensonify::terrain_tool {

/// Prints what laws of the scenario's sediments must know of a layered seabed's facets, and where one law cannot do for
/// all of a class; nothing for other seabeds.
void print_facets(const Scenario& scenario);

}  // namespace ensonify::terrain_tool
