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

/// Lambert's law (lambert.h).
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
/// what the sediment does (resolved.h).
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

}  // namespace ensonify::seabed
