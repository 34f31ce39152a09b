#pragma once

#include "kernels/seabed/law.h"

namespace ensonify::seabed {

/// Law for the facets of a mesh that carries part of the relief that `whole` counts.
///
/// A law of a sediment is that of a plane: slopes of all its relief are in it. Where the mesh has part of these slopes
/// itself, its facets with that law would count them twice. This is the law that counts them once: facets tilted at
/// random about the plane, with Gaussian slopes that are the same in all directions and have this mean square (the
/// square of the gradient: both directions together, a ratio), return on average over the plane's area what `whole`
/// returns of the plane, at every grazing angle.
///
/// Found by dividing by what tilting adds, a few times over ([Gold1964]'s scheme, in decibels): the average then
/// is that of `whole` within 0.3 dB from 20 degrees of grazing up, for the named sediments from coarse sand to clay,
/// 100 to 300 kHz, rms slopes up to 0.17 (posts of 0.1 m); for rock too (0.27), for rough rock within 0.5 dB (0.7).
/// Laws with an edge cannot be had of facets tilted by as much: a capped rough rock's is 2.4 dB off at 60 degrees, with
/// 0.37. Slopes are taken to be Gaussian, by twenty sizes of equal probability up to 1.9 times their rms (2.7 times
/// that along one direction). At grazing angles within about twice the rms slope, facets that face the sound return
/// more than the plane does whatever the law of those that do not: nothing is changed by more than 6 dB, and the
/// average stays above `whole`. Shadows are the mesh's own. With 0: `whole` itself.
/// @throws std::invalid_argument for a mean square that is not finite, negative, or above 0.5 (facets of 35 degrees).
Law law_of_facets(const Law& whole, double mean_square_slope);

/// Mean return of facets of that law from a unit of the plane's area, over tilts of that mean square slope;
/// slopes as above, without shadows.
double mean_over_facets(const Law& facets, double mean_square_slope, double grazing_rad);

}  // namespace ensonify::seabed
