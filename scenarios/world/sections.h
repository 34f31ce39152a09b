#pragma once

#include <string>

#include "components/config/config_reader.h"
#include "components/config/parameter_info.h"
#include "scenarios/world/world.h"

/// Keys of a scenario whose reader is code, for the schema of scenario files.

namespace ensonify {

/// `ensonify: scenario/1` at the head of a file.
ParameterInfo format_info(const std::string& format);
ParameterInfo text_info(const std::string& key, const std::string& about, bool required = false);
ParameterInfo file_info(const std::string& key, const std::string& about, bool required = true);
ParameterInfo word_info(const std::string& key, const std::string& about, Allowed words);
/// A list of classes of the seabed.
ParameterInfo classes_info(const std::string& key, const std::string& about);
/// A file's path, or a map.
ParameterInfo file_or_info(const std::string& key, const std::string& about, const ParameterList& map);
/// One word, or a map.
ParameterInfo word_or_info(const std::string& key, const std::string& about, const std::string& word,
                           const ParameterList& map);
/// A map from names of a pattern to words or maps.
ParameterInfo words_or_maps_info(const std::string& key, const std::string& about, const std::string& names,
                                 const Allowed& words, const ParameterList& map);
/// A list of maps, each with the keys of one of the sections in `forms`.
ParameterInfo forms_info(const std::string& key, const std::string& about, const ParameterList& forms);

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
