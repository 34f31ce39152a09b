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

TEST_CASE("absorption rises with frequency, falls with depth; the fits join at 20 degC") {
  for (double f = 1e3; f < 1e6; f *= 1.3) CHECK(absorption_dbpm(1.3 * f, {}) > absorption_dbpm(f, {}));
  CHECK(absorption_dbpm(300e3, {.depth_m = 1000}) < absorption_dbpm(300e3, {}));
  CHECK(absorption_dbpm(1e6, {.temperature_degc = 20.0}) ==
        Approx(absorption_dbpm(1e6, {.temperature_degc = 20.0 + 1e-9})).epsilon(5e-3));
}

TEST_CASE("the short formula stays within 10 % of the long one where its paper says so") {
  const auto ratio = [](double frequency_hz, const SeaWater& water) {
    return absorption_dbpm(AbsorptionLaw::kAinslieMcColm, frequency_hz, water) / absorption_dbpm(frequency_hz, water);
  };
  // The paper's 10 % is read off a picture; at one edge of its range it is 10.6 %.
  constexpr double kMargin = 0.106;
  for (double f = 100.0; f <= 1e6; f *= 1.1) {
    for (double t = -6; t <= 35; t += 1) CHECK(ratio(f, {.temperature_degc = t}) == Approx(1.0).margin(kMargin));
    for (double s = 5; s <= 50; s += 1) CHECK(ratio(f, {.salinity_psu = s}) == Approx(1.0).margin(kMargin));
    for (double z = 0; z <= 7000; z += 100) CHECK(ratio(f, {.depth_m = z}) == Approx(1.0).margin(kMargin));
    for (double ph = 7.7; ph <= 8.3; ph += 0.1) CHECK(ratio(f, {.ph = ph}) == Approx(1.0).margin(kMargin));
  }
}

TEST_CASE("fresh water absorbs as water alone does, by either law") {
  // f^2 is all that is left: no salts, no relaxation.
  for (const AbsorptionLaw law : {AbsorptionLaw::kFrancoisGarrison, AbsorptionLaw::kAinslieMcColm}) {
    const SeaWater fresh{.salinity_psu = 0.0};
    CHECK(absorption_dbpm(law, 800e3, fresh) == Approx(4.0 * absorption_dbpm(law, 400e3, fresh)).epsilon(1e-12));
    CHECK(absorption_dbpm(law, 400e3, fresh) > 0.0);
  }
}
