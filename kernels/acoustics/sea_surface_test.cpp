#include "kernels/acoustics/sea_surface.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

using namespace ensonify::surface;
using Catch::WithinAbs;

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

double strength_db(double degrees, double frequency_hz, double wind_speed_mps) {
  return 10 * std::log10(sea_surface_backscatter(degrees * kDegree, frequency_hz, wind_speed_mps).total);
}

}  // namespace

TEST_CASE("values equal an independent implementation's and the report's figures") {
  CHECK_THAT(strength_db(20, 15e3, 3.5), WithinAbs(-47.2, 0.1));
  CHECK_THAT(strength_db(30, 70e3, 8), WithinAbs(-24.5, 0.1));
  CHECK_THAT(strength_db(60, 70e3, 8), WithinAbs(-20.3, 0.1));
  // Read off the figures: -47..-45 dB at 15 kHz; -24 and -19 dB, +-2, at 70 kHz.
  CHECK_THAT(strength_db(20, 15e3, 3.5), WithinAbs(-46.0, 1.3));
  CHECK_THAT(strength_db(30, 70e3, 8), WithinAbs(-24.0, 2.0));
  CHECK_THAT(strength_db(60, 70e3, 8), WithinAbs(-19.0, 2.0));
}

TEST_CASE("finite for every angle, frequency and wind, and without steps above 1 degree") {
  double greatest_step_db = 0.0;
  for (const double wind_speed_mps : {0.0, 0.5, 1.0, 3.0, 5.9, 6.1, 10.9, 11.1, 20.0, 40.0}) {
    for (const double frequency_hz : {10e3, 30e3, 100e3, 300e3, 1000e3}) {
      INFO(frequency_hz << " Hz, " << wind_speed_mps << " m/s");
      bool finite = true;
      double before_db = 0.0;
      for (int i = 0; i <= 900; ++i) {
        const double now_db = strength_db(0.1 * i, frequency_hz, wind_speed_mps);
        finite = finite && std::isfinite(now_db);
        if (i > 10) greatest_step_db = std::max(greatest_step_db, std::abs(now_db - before_db));
        before_db = now_db;
      }
      CHECK(finite);
    }
  }
  CHECK(greatest_step_db < 1.5);
}

TEST_CASE("the laws join where wind speed changes them") {
  for (const double degrees : {5.0, 30.0, 60.0, 89.0}) {
    // 6 m/s: the loss; 11 m/s: the bubbles. Their values join there.
    CHECK_THAT(strength_db(degrees, 70e3, 6 - 1e-9), WithinAbs(strength_db(degrees, 70e3, 6 + 1e-9), 1e-6));
    CHECK_THAT(strength_db(degrees, 70e3, 11 - 1e-9), WithinAbs(strength_db(degrees, 70e3, 11 + 1e-9), 1e-6));
  }
  CHECK_THAT(mean_square_slope(1.0), WithinAbs(mean_square_slope(0.99), 2e-5));  // 0.00341 and 0.0034 as printed
}

TEST_CASE("many bubbles screen each other: the strength ends at a level, whatever the wind") {
  // beta -> infinity: sigma = radiation / damping * sin(theta) / (8 pi).
  const double level = 0.0136 / (0.0255 * std::cbrt(100.0)) * std::sin(0.5) / (8 * std::numbers::pi);
  CHECK(sea_surface_backscatter(0.5, 100e3, 40).bubbles == Approx(level).epsilon(1e-6));
}

TEST_CASE("few bubbles scatter as many as there are, at any angle") {
  // beta -> 0: [8 beta + 4 beta] / 2 beta = 6.
  const double beta_v = std::pow(10.0, -5.2577);
  const double level = beta_v / (4 * std::numbers::pi) * 0.0136 / (0.0255 * std::cbrt(25.0)) * 6;
  CHECK(sea_surface_backscatter(1.0, 25e3, 0).bubbles == Approx(level).epsilon(1e-4));
}

TEST_CASE("facets hold the energy of a mirror") {
  // Seen from where it came: 4 Integral sigma cos g dOmega over incidence g.
  double energy = 0.0;
  const double step = 0.01 * kDegree;
  for (double g = 0.5 * step; g < 89.9 * kDegree; g += step) {
    energy += 4 * sea_surface_backscatter(90 * kDegree - g, 100e3, 10).facets * std::cos(g) * 2 * std::numbers::pi *
              std::sin(g) * step;
  }
  CHECK(energy == Approx(1.0).epsilon(1e-4));
}

TEST_CASE("a calm surface is a mirror that flips the phase; waves take the mirror away") {
  const double k = 2 * std::numbers::pi * 300e3 / 1500;
  CHECK(coherent_reflection(k, 0.0, 1.0) == -1.0);
  CHECK(coherent_reflection(k, 0.01, 0.0) == -1.0);
  CHECK(coherent_reflection(k, 0.5 / k, 90 * kDegree) == Approx(-std::exp(-0.5)));  // k sigma_h = 1/2
  CHECK(std::abs(coherent_reflection(k, rms_wave_height_m(5.0), 45 * kDegree)) < 1e-100);
}

TEST_CASE("Pierson-Moskowitz heights: significant 0.53, 2.13 and 4.80 m at 5, 10 and 15 m/s") {
  CHECK_THAT(4 * rms_wave_height_m(5), WithinAbs(0.53, 0.005));
  CHECK_THAT(4 * rms_wave_height_m(10), WithinAbs(2.13, 0.005));
  CHECK_THAT(4 * rms_wave_height_m(15), WithinAbs(4.80, 0.005));
}

TEST_CASE("what the law cannot take is refused") {
  CHECK_THROWS_WITH(sea_surface_backscatter(1.0, 0.0, 5), "frequency 0.000000 Hz: allowed is above 0");
  CHECK_THROWS_WITH(sea_surface_backscatter(1.0, 1e5, -1), "wind speed -1.000000 m/s: allowed is 0 or more");
}
