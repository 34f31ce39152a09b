#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <variant>

#include "kernels/seabed/law.h"

namespace ensonify {

/// Sediment as facets of that rms slope (0 to 35 degrees) change it.
seabed::MeshedSediment on_facets(const std::variant<seabed::SedimentParameters, seabed::CappedSediment>& whole,
                                 double facet_slope_deg);

/// A scenario's sediments as they scatter on a mesh whose facets have these mean square slopes, by class: those by
/// TR 9407 become those of facets, where the scenario does not say itself how steep these are. 0, or a class beyond the
/// end: as it was.
std::map<std::uint8_t, seabed::Scatterer> on_mesh(std::map<std::uint8_t, seabed::Scatterer> sediments,
                                                  std::span<const double> mean_square_slope);

/// The same slope of a meshed sediment.
double facet_slope_deg(const seabed::MeshedSediment& meshed);

}  // namespace ensonify
