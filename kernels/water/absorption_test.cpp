#include "kernels/water/absorption.h"

#include <catch2/catch.hpp>

using namespace ensonify::water;

TEST_CASE("absorption matches the values printed in the paper") {
  // dB/km at the surface, pH 8, printed with three digits [Francois1982].
  const auto dbpkm = [](double khz, double t_degc) {
    return 1e3 * absorption_dbpm(khz * 1e3, {t_degc, 35.0, 0.0, 8.0});
  };
  CHECK(dbpkm(100, 10) == Approx(33.6).margin(0.05));
  CHECK(dbpkm(200, 0) == Approx(40.6).margin(0.05));
  CHECK(dbpkm(300, 10) == Approx(73.1).margin(0.05));
  CHECK(dbpkm(500, 10) == Approx(125).margin(0.5));
  CHECK(dbpkm(700, 4) == Approx(228).margin(0.5));
  CHECK(dbpkm(1000, 30) == Approx(344).margin(0.5));
}

TEST_CASE("absorption rises with frequency, falls with depth, and the two pure-water fits meet at 20 degC") {
  for (double f = 1e3; f < 1e6; f *= 1.3) CHECK(absorption_dbpm(1.3 * f, {}) > absorption_dbpm(f, {}));
  CHECK(absorption_dbpm(300e3, {.depth_m = 1000}) < absorption_dbpm(300e3, {}));
  CHECK(absorption_dbpm(1e6, {.temperature_degc = 20.0}) ==
        Approx(absorption_dbpm(1e6, {.temperature_degc = 20.0 + 1e-9})).epsilon(5e-3));
}
