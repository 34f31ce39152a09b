#include "kernels/water/sound_speed.h"

#include <cmath>

namespace ensonify::water {
namespace {

constexpr double kPaPerBar = 1e5;
constexpr double kPaPerKgfPerCm2 = 98066.5;

bool within(double value, double low, double high) { return value >= low && value <= high; }

}  // namespace

double sound_speed_mps(double temperature_degc, double salinity_psu, double depth_m) {
  const double T = temperature_degc;
  const double S = salinity_psu - 35.0;
  const double D = depth_m;

  const double surface = 1448.96 + 4.591 * T - 5.304e-2 * T * T + 2.374e-4 * T * T * T;
  const double salinity = 1.340 * S - 1.025e-2 * T * S;
  const double pressure = 1.630e-2 * D + 1.675e-7 * D * D - 7.139e-13 * T * D * D * D;
  return surface + salinity + pressure;  // [Mackenzie1981], the nine terms grouped by cause
}

double unesco_sound_speed_mps(double temperature_degc, double salinity_psu, double pressure_pa) {
  const double T = temperature_degc;
  const double S = salinity_psu;
  const double P = pressure_pa / kPaPerBar;

  // [Fofonoff1983] section 9 with the coefficients of [WongZhu1995] table I: pure water, then powers of salinity.
  const double C0 = 1402.388 + (5.03830 + (-5.81090e-2 + (3.3432e-4 + (-1.47797e-6 + 3.1419e-9 * T) * T) * T) * T) * T;
  const double C1 = 0.153563 + (6.8999e-4 + (-8.1829e-6 + (1.3632e-7 - 6.1260e-10 * T) * T) * T) * T;
  const double C2 = 3.1260e-5 + (-1.7111e-6 + (2.5986e-8 + (-2.5353e-10 + 1.0415e-12 * T) * T) * T) * T;
  const double C3 = -9.7729e-9 + (3.8513e-10 - 2.3654e-12 * T) * T;
  const double Cw = C0 + (C1 + (C2 + C3 * P) * P) * P;

  const double A0 = 1.389 + (-1.262e-2 + (7.166e-5 + (2.008e-6 - 3.21e-8 * T) * T) * T) * T;
  const double A1 = 9.4742e-5 + (-1.2583e-5 + (-6.4928e-8 + (1.0515e-8 - 2.0142e-10 * T) * T) * T) * T;
  const double A2 = -3.9064e-7 + (9.1061e-9 + (-1.6009e-10 + 7.994e-12 * T) * T) * T;
  const double A3 = 1.100e-10 + (6.651e-12 - 3.391e-13 * T) * T;
  const double A = A0 + (A1 + (A2 + A3 * P) * P) * P;

  const double B = -1.922e-2 - 4.42e-5 * T + (7.3637e-5 + 1.7950e-7 * T) * P;
  const double D = 1.727e-3 - 7.9836e-6 * P;
  return Cw + A * S + B * S * std::sqrt(S) + D * S * S;
}

double del_grosso_sound_speed_mps(double temperature_degc, double salinity_psu, double pressure_pa) {
  const double T = temperature_degc;
  const double S = salinity_psu;
  const double P = pressure_pa / kPaPerKgfPerCm2;

  // [WongZhu1995] table II.
  const double CT = (0.5012285e1 + (-0.551184e-1 + 0.221649e-3 * T) * T) * T;
  const double CS = (0.1329530e1 + 0.1288598e-3 * S) * S;
  const double CP = (0.1560592 + (0.2449993e-4 - 0.8833959e-8 * P) * P) * P;
  const double CST = (-0.1275936e-1 + 0.9688441e-4 * T) * S * T;
  const double CTP =
      (0.6353509e-2 - 0.4383615e-6 * T * T) * T * P + (-0.1593895e-5 + 0.2656174e-7 * T + 0.5222483e-9 * P) * T * P * P;
  const double CSTP = (-0.3406824e-3 + 0.4857614e-5 * S) * S * T * P - 0.1616745e-8 * S * S * P * P;
  return 1402.392 + CT + CS + CP + CST + CTP + CSTP;
}

double sound_speed_mps(SoundSpeedLaw law, double temperature_degc, double salinity_psu, double depth_m,
                       double latitude_rad) {
  switch (law) {
    case SoundSpeedLaw::kMackenzie: break;
    case SoundSpeedLaw::kUnesco:
      return unesco_sound_speed_mps(temperature_degc, salinity_psu, sea_pressure_pa(depth_m, latitude_rad));
    case SoundSpeedLaw::kDelGrosso:
      return del_grosso_sound_speed_mps(temperature_degc, salinity_psu, sea_pressure_pa(depth_m, latitude_rad));
  }
  return sound_speed_mps(temperature_degc, salinity_psu, depth_m);
}

bool in_range(SoundSpeedLaw law, double temperature_degc, double salinity_psu, double depth_m, double latitude_rad) {
  const double T = temperature_degc;
  const double S = salinity_psu;
  const double pressure_pa = sea_pressure_pa(depth_m, latitude_rad);
  switch (law) {
    case SoundSpeedLaw::kMackenzie: break;
    case SoundSpeedLaw::kUnesco:
      return within(T, 0, 40) && within(S, 0, 40) && within(pressure_pa, 0, 1000 * kPaPerBar);
    case SoundSpeedLaw::kDelGrosso:
      return within(T, 0, 30) && within(S, 30, 40) && within(pressure_pa, 0, 1000 * kPaPerKgfPerCm2);
  }
  return within(T, 2, 30) && within(S, 25, 40) && within(depth_m, 0, 8000);
}

double sea_pressure_pa(double depth_m, double latitude_rad) {
  // [Saunders1981]: z = (1 - c1) p - c2 p^2, p in dbar, solved for p.
  const double sin_latitude = std::sin(latitude_rad);
  const double c1 = 5.92e-3 + 5.25e-3 * sin_latitude * sin_latitude;
  const double c2 = 2.21e-6;
  const double p_dbar = ((1.0 - c1) - std::sqrt((1.0 - c1) * (1.0 - c1) - 4.0 * c2 * depth_m)) / (2.0 * c2);
  return p_dbar * 1e4;
}

}  // namespace ensonify::water
