#pragma once

namespace ensonify::water {

/// The state of sea water that absorption depends on.
struct SeaWater {
  double temperature_degc = 10.0;
  double salinity_psu = 35.0;
  double depth_m = 0.0;  // positive down
  double ph = 8.0;
};

/// Absorption of sound in sea water, in dB/m.
///
/// [Francois1982]: boric acid, magnesium sulphate and pure water. Good to about 5 % for 200 Hz..1 MHz, -2..22 degC (to
/// 30 degC above 400 kHz), 30..35 psu, 0..3500 m; outside it is still evaluated. The boric factor is the paper's 8.86;
/// 8.68 in some books is a digit swap.
double absorption_dbpm(double frequency_hz, const SeaWater& water);

}  // namespace ensonify::water
