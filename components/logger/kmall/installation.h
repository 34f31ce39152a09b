#pragma once

#include <cstdint>
#include <string>

#include "components/formats/kmall/installation.h"
#include "components/formats/kmall/sound_speed.h"
#include "components/logger/vessel.h"
#include "kernels/base/frames/local_projection.h"
#include "kernels/water/refraction/profile.h"
#include "messages/sonar.h"

/// What a .kmall file begins with.
namespace ensonify::logger::kmall {

/// Of an EM 2040 that states its mountings. `mark` says that it is simulated.
formats::kmall::Installation installation(const Vessel& vessel, std::uint16_t serial, const std::string& mark);

formats::kmall::Runtime runtime(const msg::AppliedSettings& settings, bool simulator);

/// The applied profile from the surface down to 12 km, as such files have it.
formats::kmall::SoundSpeedProfile profile(const refraction::SoundSpeedProfile& applied, std::int64_t unix_ns,
                                          const frames::Geodetic& place);

}  // namespace ensonify::logger::kmall
