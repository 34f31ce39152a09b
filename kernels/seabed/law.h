#pragma once

#include <functional>
#include <variant>

#include "kernels/seabed/material.h"
#include "kernels/seabed/sediment.h"

namespace ensonify::seabed {

/// Generic seafloor acoustic backscatter [Lamarche2011]: a description of measured angular curves, to be fitted; it
/// holds no physics and no frequency. Amplitudes are ratios (10^(dB/10)), widths are standard deviations of incidence
/// angle.
struct Gsab {
  double specular = 0.0;              // A, >= 0
  double specular_width_rad = 0.1;    // B, > 0
  double diffuse = 0.0;               // C, >= 0: level at normal incidence of the Lambert-like part
  double diffuse_exponent = 2.0;      // D, >= 0: 2 is Lambert's law
  double transition = 0.0;            // E, >= 0: shoulder at moderate incidence
  double transition_width_rad = 0.3;  // F, > 0
};

/// Backscattering cross section per unit area (a ratio, not dB):
/// A exp(-phi^2 / 2 B^2) + C cos^D phi + E exp(-phi^2 / 2 F^2), phi the incidence angle.
/// Grazing angle from the local plane of the seabed, clamped to 0..pi/2.
/// @throws std::invalid_argument for a width that is not above 0.
double gsab_backscatter(const Gsab& curve, double grazing_rad);

/// Backscattering cross section per unit area (a ratio, not dB) against grazing angle, at one frequency.
using Law = std::function<double(double grazing_rad)>;

/// Lambert's law (backscatter.h).
struct Lambert {
  double mu_db = -25.0;
};

/// TR 9407 (backscatter.h), its roughness part limited to what a diffuse reflector of the same reflection coefficient
/// returns: |R90|^2 sin^2 theta / pi below 60 degrees, no limit above 75, the excess faded in dB between. Ours: the
/// report's law for rough rock rises above that, the more the higher the frequency.
struct CappedSediment {
  SedimentParameters sediment;
};

/// A sediment part of whose relief the mesh has: facets that are tilted with this mean square slope return on average
/// what the sediment does (law_of_facets).
struct MeshedSediment {
  std::variant<SedimentParameters, CappedSediment> whole;
  double mean_square_slope = 0.0;  // of the facets, both directions together
};

/// Soft body that is known by its target strength (lambert_of_target_strength).
struct Tissue {
  double target_strength_db = 0.0;  // re 1 m^2, mean over aspects
  double surface_area_m2 = 1.0;
};

/// Everything that scatters as a surface.
using Scatterer = std::variant<SedimentParameters, CappedSediment, MeshedSediment, Lambert, Gsab, Material, Tissue>;

/// @throws std::invalid_argument as SedimentBackscatter, law_of_facets and lambert_of_target_strength do.
Law law_of(const Scatterer& scatterer, double frequency_hz, double sound_speed_mps);

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
