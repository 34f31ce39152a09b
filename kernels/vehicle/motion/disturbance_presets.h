#pragma once

#include <optional>
#include <string_view>

#include "kernels/vehicle/motion/disturbance.h"

namespace ensonify::motion {

/// The motion of vessels that were measured, and of some that were not. Nothing for another name.
///
/// - research_ship: a ship of 94 m at 9.5 kn in a swell of 10 to 13 s, from ten minutes of the motion sensor of R/V
///   Nathaniel B. Palmer at 1 Hz (1 August 2014): standard deviations roll 0.58, pitch 1.86, heading 0.66 degrees,
///   heave 1.12 m; peaks at 12.8, 9.1 and 10.7 s; coherence with heave 0.54 (roll) and 0.87 (pitch), pitch a quarter of
///   a period from heave. The sign of that quarter, and how heading divides into waves and wander, are assumed.
/// - survey_launch: a small boat in sheltered water: standard deviations roll 1.7, pitch 0.8 degrees, heave 0.03 m, as
/// on
///   a multibeam test line of an unnamed launch; periods and coherence assumed.
/// - auv: a small AUV below the waves; all assumed.
std::optional<DisturbanceParameters> disturbance_preset(std::string_view name);

inline constexpr std::string_view kDisturbancePresets[] = {"research_ship", "survey_launch", "auv"};

}  // namespace ensonify::motion
