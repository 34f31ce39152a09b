#pragma once

namespace ensonify::water {

/// Gauge pressure of the sea at a depth, in Pa: zero at the surface. Latitude matters through gravity.
///
/// [Saunders1981], for standard sea water (0 degC, 35 psu), to 10 km. Within 0.07 % of the longer formula of
/// [Fofonoff1983], where 0.07 % at 1 km of depth is 0.01 m/s of sound speed. Negative depths give negative pressures.
double sea_pressure_pa(double depth_m, double latitude_rad);

}  // namespace ensonify::water
