#include "kernels/water/noise.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

using namespace ensonify::water;
using Catch::Matchers::WithinAbs;

TEST_CASE("thermal noise agrees with 4 pi k T rho f^2 / c") {
  // Mellen's derivation at 10 degC, fresh enough: rho 1027 kg/m^3, c 1490 m/s. The rounded -15 is 0.3 dB off.
  for (const double f : {100e3, 300e3, 1e6}) {
    const double pa2_per_hz = 4 * std::numbers::pi * 1.380649e-23 * 283.15 * 1027 * f * f / 1490;
    CHECK_THAT(thermal_noise_level_db(f), WithinAbs(10 * std::log10(pa2_per_hz * 1e12), 0.35));
  }
  CHECK_THAT(thermal_noise_level_db(300e3), WithinAbs(34.5, 0.05));
}

TEST_CASE("ten times the band is 10 dB more, directivity takes noise away") {
  CHECK(in_band_level_db(34.5, 1e4, 30.0) == Approx(44.5));
}

TEST_CASE("wind noise follows the rule of fives") {
  constexpr double kKnot = 1852.0 / 3600.0;
  CHECK(wind_noise_level_db(1e3, 5 * kKnot) == Approx(51.0));
  CHECK(wind_noise_level_db(1e3, 20 * kKnot) == Approx(61.0));
  CHECK(wind_noise_level_db(8e3, 5 * kKnot) == Approx(36.0));
}

TEST_CASE("thermal noise takes over from wind where the curves cross") {
  // Read off such curves: about 85 kHz in 5 m/s, 115 in 10, 140 in 15, each within some 3 %.
  const auto crossing_hz = [](double wind_speed_mps) {
    double f = 10e3;
    while (thermal_noise_level_db(f) < wind_noise_level_db(f, wind_speed_mps)) f += 100.0;
    return f;
  };
  CHECK(crossing_hz(5) == Approx(85e3).epsilon(0.03));
  CHECK(crossing_hz(10) == Approx(115e3).epsilon(0.03));
  CHECK(crossing_hz(15) == Approx(140e3).epsilon(0.03));
  const double f = crossing_hz(10);
  CHECK_THAT(ambient_noise_level_db(f, 10) - thermal_noise_level_db(f), WithinAbs(3.01, 0.03));  // of two equals
}

TEST_CASE("without wind there is thermal noise, and nothing is undefined") {
  CHECK(ambient_noise_level_db(200e3, 0) == thermal_noise_level_db(200e3));
}

TEST_CASE("directivity keeps ambient noise out, the electronics' own stays") {
  const Receiver quiet{.bandwidth_hz = 1e4, .directivity_index_db = 30.0, .electronic_noise_db = -1000.0};
  CHECK(received_noise_level_db(300e3, 0, quiet) == Approx(thermal_noise_level_db(300e3) + 40 - 30));
  const Receiver loud{.bandwidth_hz = 1e4, .directivity_index_db = 30.0, .electronic_noise_db = 60.0};
  CHECK_THAT(received_noise_level_db(300e3, 0, loud), WithinAbs(100.0, 2e-5));  // thermal noise is 55 dB below
}
