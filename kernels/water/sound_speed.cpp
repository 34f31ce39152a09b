#include "kernels/water/sound_speed.h"

namespace ensonify::water {

double sound_speed_mps(double temperature_degc, double salinity_psu, double depth_m) {
  const double T = temperature_degc;
  const double S = salinity_psu - 35.0;
  const double D = depth_m;

  const double surface = 1448.96 + 4.591 * T - 5.304e-2 * T * T + 2.374e-4 * T * T * T;
  const double salinity = 1.340 * S - 1.025e-2 * T * S;
  const double pressure = 1.630e-2 * D + 1.675e-7 * D * D - 7.139e-13 * T * D * D * D;
  return surface + salinity + pressure;  // [Mackenzie1981], the nine terms grouped by cause
}

bool in_range(double temperature_degc, double salinity_psu, double depth_m) {
  return temperature_degc >= 2.0 && temperature_degc <= 30.0 && salinity_psu >= 25.0 && salinity_psu <= 40.0 &&
         depth_m >= 0.0 && depth_m <= 8000.0;
}

}  // namespace ensonify::water
