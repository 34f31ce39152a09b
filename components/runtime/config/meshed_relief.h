#pragma once

#include <cstdint>

#include "components/runtime/config/scenario_seabed.h"

namespace ensonify {

/// The rms slope, in degrees, that facets of a layered seabed's mesh have by relief that the law of this class counts
/// too; rounded to 1e-4 degrees, so that a file can say the same number. At most 35.
///
/// Counted are spectral layers that give the class, and those without a class that add to the seabed at half of its
/// places or more; the sum of their slopes from post to post (relief::facet_mean_square_slope), but no more than the
/// sediment's own spectrum has there. By class, not by place: of a layer that is rougher here than there
/// (intermittency, height gain, `rough`) the slope of a typical place, which half of the places exceed. With the mean
/// square, which few rough places make, the others' echoes would come out too strong by several dB.
/// How many places a mask leaves is taken from its polygon, patches and classes. Not counted: layers without a class
/// masked by depth, slope or curvature; shapes, ripples, bodies, marks, which no law of a sediment knows of; detail
/// restored below a guide, whose strength the guide says.
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
