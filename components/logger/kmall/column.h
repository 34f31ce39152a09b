#pragma once

#include "components/formats/kmall/water_column.h"
#include "components/logger/format.h"
#include "components/logger/vessel.h"

namespace ensonify::logger::kmall {

/// #CHE of a ping: heave at the transducer.
formats::kmall::Heave heave(const LoggedSoundings& ping, const Vessel& vessel);

/// #MWC of a ping with a water column, without phases.
formats::kmall::WaterColumn water_column(const LoggedSoundings& ping, const Vessel& vessel);

}  // namespace ensonify::logger::kmall
