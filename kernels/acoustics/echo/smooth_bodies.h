#pragma once

#include <span>

#include "kernels/acoustics/echo/cell_columns.h"
#include "kernels/acoustics/echo/scatterer.h"
#include "kernels/acoustics/trace/ray_distribution.h"

namespace ensonify::echo {

/// What the facets of smooth bodies send back, one scatterer for each that its ray has found, appended to `found` in
/// the order of rays; its response is no random one but the facet's phase (facet_amplitude_m). `to_bodies` are the
/// targets of the batch's last rays (trace::RayDistribution::Batch). `hits` are the batch's own: those that are taken
/// become misses, so that nothing else is made of them. Where a part of a facet is hidden, its one ray decides for all
/// of it.
void take_smooth_facets(const Insonification& batch, std::span<const trace::BodyTarget> to_bodies,
                        double wavenumber_radpm, trace::Hits& hits, Scatterers& found);

}  // namespace ensonify::echo
