#pragma once

#include "components/terrain/meshed_relief.h"
#include "scenarios/world/seabed.h"

namespace ensonify::terrain_tool {

/// Prints what laws of a layered seabed's sediments must know of its facets, and where one law cannot do for all of a
/// class; nothing for other seabeds.
void print_facets(const Seabed& seabed, const source::MeshedRelief& relief);

}  // namespace ensonify::terrain_tool
