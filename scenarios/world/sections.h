#pragma once

#include "components/config/config_reader.h"
#include "scenarios/world/seabed.h"
#include "scenarios/world/water.h"

namespace ensonify {

inline constexpr double kFarAway_m = 100e3;  // nothing in a world is farther from its origin

/// The sections of a scenario file that have a source file of their own.
Water read_water(ConfigReader from);
Seabed read_seabed(ConfigReader from);
/// The list `layers` of a seabed.
std::vector<layers::Layer> read_layers(const ConfigReader& seabed);
/// The map `meshes` of a seabed whose sediments are known.
void read_meshes(const ConfigReader& from, Seabed& seabed);
/// A list of classes of the seabed; empty when left out.
std::vector<std::uint8_t> read_classes(ConfigReader& from, const char* key);

}  // namespace ensonify
