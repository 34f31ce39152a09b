#pragma once

#include <cstdint>
#include <string>

#include "components/formats/all/installation.h"
#include "components/formats/all/sound_speed.h"
#include "components/logger/vessel.h"
#include "kernels/water/refraction/profile.h"
#include "messages/sonar.h"

/// What a .all file begins with.
namespace ensonify::logger {

/// Of a system that states its mountings. It says in its survey's name that it is simulated.
formats::all::Installation installation(const Vessel& vessel, std::uint16_t serial, const std::string& file_name,
                                        const std::string& mark);

formats::all::Runtime runtime(const msg::AppliedSettings& settings);

/// The applied profile from the surface down to 12 km, as such files have it.
formats::all::SoundSpeedProfile profile(const refraction::SoundSpeedProfile& applied, std::int64_t unix_ns);

}  // namespace ensonify::logger
