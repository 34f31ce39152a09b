#pragma once

#include "kernels/acoustics/echo/arrival.h"
#include "kernels/water/refraction/profile.h"

namespace ensonify::echo {

/// add_direct_echoes with an eigenray of its own for each way of each echo: what that function's first order is
/// compared with. Depths of the profile count from z = 0.
///
/// Time: that of the path from the place of transmission to the scatterer, and of the path from there to where the
/// receiver is then (found by iteration, to 1e-12 s). Direction: of the path back, at the receiver. Mean square: over
/// the tube's area on the way back. Absorption: along both paths. The ray's own history says along which of several
/// paths sound came: where the eigenray's time differs from it by more than 1e-4 of it, or where there is none, the
/// echo is that of add_direct_echoes.
void add_eigenray_echoes(const Carrier& carrier, const refraction::SoundSpeedProfile& profile,
                         const frames::Vec3& source_enu_m, const Scatterers& scatterers, const Receivers& receivers,
                         Arrivals& arrivals);

/// Puts them into the rows of the scatterers' direct echoes, which begin at `first`.
void take_eigenrays(const Carrier& carrier, const refraction::SoundSpeedProfile& profile,
                    const frames::Vec3& source_enu_m, const Scatterers& scatterers, const Receivers& receivers,
                    std::size_t first, Arrivals& arrivals);

}  // namespace ensonify::echo
