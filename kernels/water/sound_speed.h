#pragma once

namespace ensonify::water {

/// The published fits to the speed of sound in sea water.
///
/// | law | temperature | salinity | depth or pressure | error |
/// |---|---|---|---|---|
/// | kMackenzie [Mackenzie1981], nine terms | 2..30 degC (some reprints say -2) | 25..40 psu | 0..8000 m | 0.07 m/s |
/// | kUnesco, Chen and Millero [Fofonoff1983] in ITS-90 [WongZhu1995] | 0..40 | 0..40 | 0..1000 bar | 0.19 |
/// | kDelGrosso in ITS-90 [WongZhu1995] | 0..30 | 30..40 | 0..1000 kg/cm^2 | 0.05 |
///
/// Outside these ranges the polynomials are still evaluated; callers that care use in_range(). Errors are the standard
/// errors of the fits. At depth the measurements favour Del Grosso [SpiesbergerMetzger1991].
enum class SoundSpeedLaw { kMackenzie, kUnesco, kDelGrosso };

/// At about 45 degrees a cubic metre weighs what it weighs on average.
constexpr double kMeanLatitude_rad = 0.785398163397448;

/// Speed of sound in sea water, in m/s; depth is positive down. Latitude serves the laws that want pressure.
double sound_speed_mps(SoundSpeedLaw law, double temperature_degc, double salinity_psu, double depth_m,
                       double latitude_rad = kMeanLatitude_rad);

/// Whether the law was made for these values.
bool in_range(SoundSpeedLaw law, double temperature_degc, double salinity_psu, double depth_m,
              double latitude_rad = kMeanLatitude_rad);

/// The laws in their own variables; pressure is gauge, as sea_pressure_pa() gives it.
double sound_speed_mps(double temperature_degc, double salinity_psu, double depth_m);  // Mackenzie
double unesco_sound_speed_mps(double temperature_degc, double salinity_psu, double pressure_pa);
double del_grosso_sound_speed_mps(double temperature_degc, double salinity_psu, double pressure_pa);

/// Gauge pressure of the sea at a depth, in Pa: zero at the surface. Latitude matters through gravity.
///
/// [Saunders1981], for standard sea water (0 degC, 35 psu), to 10 km. Within 0.07 % of the longer formula of
/// [Fofonoff1983], where 0.07 % at 1 km of depth is 0.01 m/s of sound speed. Negative depths give negative pressures.
double sea_pressure_pa(double depth_m, double latitude_rad);

}  // namespace ensonify::water
