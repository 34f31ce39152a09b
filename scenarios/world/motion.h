#pragma once

#include <optional>

#include "kernels/vehicle/motion/current.h"
#include "kernels/vehicle/motion/disturbance.h"
#include "kernels/vehicle/vertical/draught.h"

namespace ensonify {

class ConfigReader;

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

}  // namespace ensonify
