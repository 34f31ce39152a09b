#pragma once

#include <functional>
#include <variant>

#include "kernels/seabed/gsab.h"
#include "kernels/seabed/material.h"
#include "kernels/seabed/sediment.h"

namespace ensonify::seabed {

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
