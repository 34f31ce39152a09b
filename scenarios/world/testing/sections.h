#pragma once

#include "components/config/read_parameters.h"
#include "scenarios/world/seabed_keys.h"
#include "scenarios/world/water_keys.h"

namespace ensonify {

/// Sections of a scenario alone.
inline Water read_water(ConfigReader from) {
  WaterKeys keys;
  read_parameters(from, keys);
  return keys.water();
}
inline Seabed read_seabed(ConfigReader from) {
  SeabedKeys keys;
  read_parameters(from, keys);
  return keys.seabed();
}

}  // namespace ensonify
