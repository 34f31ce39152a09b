#pragma once

#include "components/formats/kmall/soundings.h"
#include "components/logger/format.h"
#include "components/logger/vessel.h"

namespace ensonify::logger::kmall {

/// #MRZ of a ping. Its image is the head's; without one, one sample a sounding, of its strength. `height_m` is that of
/// the reference point above the ellipsoid.
formats::kmall::Soundings soundings(const LoggedSoundings& ping, const Vessel& vessel, double height_m);

}  // namespace ensonify::logger::kmall
