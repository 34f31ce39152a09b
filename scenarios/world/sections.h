#pragma once

#include "components/config/config_reader.h"
#include "scenarios/world/infos.h"
#include "scenarios/world/world.h"

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

/// `disturbance:` of a vehicle: a preset, and axes that differ from it.
motion::DisturbanceParameters read_disturbance(ConfigReader from);

/// `current:` of a scenario.
motion::Current read_current(ConfigReader from, double start_unix_s);

/// `floats:` of a vehicle: settlement and loading.
vertical::Loading read_loading(ConfigReader from);

/// A tidal constituent's phase at sim time 0 from its phase at `reference_utc` (the scenario's start when left out).
double phase_at_start_rad(ConfigReader& from, double phase_rad, double speed_radps, double start_unix_s);
/// `constituent:` by name, in rad/s.
double read_constituent_radps(ConfigReader& from);
/// One of `vehicles:`.
Vehicle read_vehicle(const std::string& name, ConfigReader& from);

/// What may stand in a section: the lists that its reader uses, for scenario_list().
ParameterList current_list();
ParameterList disturbance_list();
ParameterList layer_list();
ParameterList loading_list();
ParameterList meshes_list();
ParameterList seabed_list();
ParameterList site_list();
ParameterList vehicle_list();
ParameterList vertical_list();
ParameterList water_list();
/// A constituent's name and phase, of a tide or a stream.
ParameterList constituent_list();

}  // namespace ensonify
