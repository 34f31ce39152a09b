#pragma once

#include <vector>

#include "components/formats/all/water_column.h"
#include "components/logger/format.h"
#include "components/logger/vessel.h"

namespace ensonify::logger {

/// k of a ping with a water column: as many as it takes, as each also goes over a network. Empty without samples.
std::vector<formats::all::WaterColumn> water_column(const LoggedSoundings& ping, const Vessel& vessel);

}  // namespace ensonify::logger
