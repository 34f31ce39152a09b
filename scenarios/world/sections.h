#pragma once

#include "components/config/config_reader.h"
#include "scenarios/world/world.h"

namespace ensonify {

/// Sections of a scenario alone, as tests and tools have them.
Water read_water(ConfigReader from);
Seabed read_seabed(ConfigReader from);

}  // namespace ensonify
