#pragma once

#include "components/config/config_reader.h"
#include "scenarios/world/infos.h"
#include "scenarios/world/mission.h"
#include "scenarios/world/seabed.h"
#include "scenarios/world/water.h"

namespace ensonify {

/// The sections of a scenario file that have a source file of their own.
Water read_water(ConfigReader from);
Seabed read_seabed(ConfigReader from);
/// The list `layers` of a seabed.
std::vector<layers::Layer> read_layers(const ConfigReader& seabed);
/// The map `meshes` of a seabed whose sediments are known.
void read_meshes(const ConfigReader& from, Seabed& seabed);
/// A list of classes of the seabed; empty when left out.
std::vector<std::uint8_t> read_classes(ConfigReader& from, const char* key);

/// What may stand in a section: the lists that its reader uses, for the schema of scenario files (schema.h).
ParameterList current_list();
ParameterList disturbance_list();
ParameterList layer_list();
ParameterList loading_list();
ParameterList meshes_list();
ParameterList mission_list();
ParameterList seabed_list();
ParameterList site_list();
ParameterList vehicle_list();
ParameterList vertical_list();
ParameterList water_list();
/// A constituent's name and phase, of a tide or a stream.
ParameterList constituent_list();

}  // namespace ensonify
