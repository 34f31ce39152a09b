#include "kernels/water/absorption.h"

#include <cmath>

namespace ensonify::water {
namespace {

constexpr double kKmPerM = 1e-3;  // the papers' sums are in dB/km

double ainslie_mccolm_dbpm(double frequency_hz, const SeaWater& water) {
  const double f = frequency_hz * 1e-3;  // kHz
  const double T = water.temperature_degc;
  const double S = water.salinity_psu;
  const double z = water.depth_m * 1e-3;  // km

  const double f1 = 0.78 * std::sqrt(S / 35.0) * std::exp(T / 26.0);
  const double boric_acid = 0.106 * f1 * f * f / (f * f + f1 * f1) * std::exp((water.ph - 8.0) / 0.56);

  const double f2 = 42.0 * std::exp(T / 17.0);
  const double magnesium_sulphate =
      0.52 * (1.0 + T / 43.0) * (S / 35.0) * f2 * f * f / (f * f + f2 * f2) * std::exp(-z / 6.0);

  const double pure_water = 0.00049 * f * f * std::exp(-(T / 27.0 + z / 17.0));
  return (boric_acid + magnesium_sulphate + pure_water) * kKmPerM;
}

}  // namespace

double absorption_dbpm(double frequency_hz, const SeaWater& water) {
  const double f = frequency_hz * 1e-3;  // kHz
  const double T = water.temperature_degc;
  const double S = water.salinity_psu;
  const double D = water.depth_m;
  const double theta = T + 273.0;
  const double c = 1412.0 + 3.21 * T + 1.19 * S + 0.0167 * D;

  const double A1 = 8.86 / c * std::pow(10.0, 0.78 * water.ph - 5.0);
  const double f1 = 2.8 * std::sqrt(S / 35.0) * std::pow(10.0, 4.0 - 1245.0 / theta);
  const double boric_acid = A1 * f1 * f * f / (f1 * f1 + f * f);

  const double A2 = 21.44 * S / c * (1.0 + 0.025 * T);
  const double P2 = 1.0 - 1.37e-4 * D + 6.2e-9 * D * D;
  const double f2 = 8.17 * std::pow(10.0, 8.0 - 1990.0 / theta) / (1.0 + 0.0018 * (S - 35.0));
  const double magnesium_sulphate = A2 * P2 * f2 * f * f / (f2 * f2 + f * f);

  const double A3 = T <= 20.0 ? 4.937e-4 - 2.59e-5 * T + 9.11e-7 * T * T - 1.50e-8 * T * T * T
                              : 3.964e-4 - 1.146e-5 * T + 1.45e-7 * T * T - 6.5e-10 * T * T * T;
  const double P3 = 1.0 - 3.83e-5 * D + 4.9e-10 * D * D;
  const double pure_water = A3 * P3 * f * f;

  return (boric_acid + magnesium_sulphate + pure_water) * kKmPerM;
}

double absorption_dbpm(AbsorptionLaw law, double frequency_hz, const SeaWater& water) {
  return law == AbsorptionLaw::kAinslieMcColm ? ainslie_mccolm_dbpm(frequency_hz, water)
                                              : absorption_dbpm(frequency_hz, water);
}

}  // namespace ensonify::water
