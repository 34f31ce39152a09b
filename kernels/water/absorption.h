#pragma once

namespace ensonify::water {

/// The state of sea water that absorption depends on.
struct SeaWater {
  double temperature_degc = 10.0;
  double salinity_psu = 35.0;
  double depth_m = 0.0;  // positive down
  double ph = 8.0;
};

/// The published fits to absorption in sea water.
///
/// kFrancoisGarrison [Francois1982]: boric acid, magnesium sulphate and pure water. Good to about 5 % for 200 Hz..1
/// MHz, -2..22 degC (to 30 degC above 400 kHz), 30..35 psu, 0..3500 m. The boric factor is the paper's 8.86; 8.68 in
/// some books is a digit swap.
///
/// kAinslieMcColm [AinslieMcColm1998]: the same three terms, shorter. Within 10 % of the other for 100 Hz..1 MHz, pH
/// 7.7..8.3 and, one at a time around 10 degC, 35 psu, the surface: -6..35 degC, 5..50 psu, 0..7 km.
///
/// Outside these ranges both are still evaluated.
enum class AbsorptionLaw { kFrancoisGarrison, kAinslieMcColm };

/// Absorption of sound in sea water, in dB/m.
double absorption_dbpm(AbsorptionLaw law, double frequency_hz, const SeaWater& water);

/// The same by Francois and Garrison.
double absorption_dbpm(double frequency_hz, const SeaWater& water);

}  // namespace ensonify::water
