#include "kernels/water/noise.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

using namespace ensonify::water;

TEST_CASE("thermal noise agrees with 4 pi k T rho f^2 / c") {
  // Mellen's derivation at 10 degC, fresh enough: rho 1027 kg/m^3, c 1490 m/s. The rounded -15 is 0.3 dB off.
  for (const double f : {100e3, 300e3, 1e6}) {
    const double pa2_per_hz = 4 * std::numbers::pi * 1.380649e-23 * 283.15 * 1027 * f * f / 1490;
    CHECK(thermal_noise_level_db(f) == Approx(10 * std::log10(pa2_per_hz * 1e12)).margin(0.35));
  }
  CHECK(thermal_noise_level_db(300e3) == Approx(34.5).margin(0.05));
}

TEST_CASE("ten times the band is 10 dB more, directivity takes noise away") {
  CHECK(in_band_level_db(34.5, 1e4, 30.0) == Approx(44.5));
}
