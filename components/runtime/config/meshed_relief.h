#pragma once

#include <cstdint>

#include "components/runtime/config/scenario_seabed.h"

namespace ensonify {

/// The rms slope, in degrees, that facets of a layered seabed's mesh have by relief that the law of this class counts
/// too; rounded to 1e-4 degrees, so that a file can say the same number. At most 35.
///
/// Counted are spectral layers that add to the seabed everywhere, and those that give the class; the sum of their
/// slopes from post to post (relief::facet_mean_square_slope), but no more than the sediment's own spectrum has there.
/// By class, not by place. Not counted: layers that are rougher here than there (intermittency, height gain, `rough`),
/// whose slopes have no one size; shapes, ripples, bodies, marks, which no law of a sediment knows of; detail restored
/// below a guide, whose strength the guide says.
double facet_slope_deg(const Seabed& seabed, std::uint8_t seabed_class, const seabed::SedimentParameters& sediment);

/// What facets of that rms slope (0 to 35 degrees) make of a sediment.
seabed::MeshedSediment on_facets(const std::variant<seabed::SedimentParameters, seabed::CappedSediment>& whole,
                                 double facet_slope_deg);

/// The same slope of a meshed sediment.
double facet_slope_deg(const seabed::MeshedSediment& meshed);

/// A layered seabed's sediments by TR 9407 become those of its facets, where the file does not say itself how steep
/// these are.
void count_meshed_relief(Seabed& seabed);

}  // namespace ensonify
