#pragma once

namespace ensonify::water {

/// Speed of sound in sea water, in m/s.
///
/// Mackenzie's nine-term fit [Mackenzie1981]. Standard error 0.07 m/s inside its range:
/// temperature 2..30 degC (some reprints say -2), salinity 25..40 psu, depth 0..8000 m, positive down.
/// Outside that range the polynomial is still evaluated; callers that care use in_range().
double sound_speed_mps(double temperature_degc, double salinity_psu, double depth_m);

/// Whether the fit was made for these values.
bool in_range(double temperature_degc, double salinity_psu, double depth_m);

}  // namespace ensonify::water
