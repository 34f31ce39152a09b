#pragma once

#include <variant>

#include "kernels/seabed/law.h"

namespace ensonify {

/// What facets of that rms slope (0 to 35 degrees) make of a sediment.
seabed::MeshedSediment on_facets(const std::variant<seabed::SedimentParameters, seabed::CappedSediment>& whole,
                                 double facet_slope_deg);

/// The same slope of a meshed sediment.
double facet_slope_deg(const seabed::MeshedSediment& meshed);

}  // namespace ensonify
