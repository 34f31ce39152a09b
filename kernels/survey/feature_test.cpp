#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "kernels/survey/spacing.h"

using namespace ensonify::survey;

TEST_CASE("a head waits for its echo: 75 m at 1500 m/s are ten pings a second") {
  CHECK(ping_rate_hz(75.0, 1500.0, 0.0, 50.0) == Approx(10.0));
  CHECK(ping_rate_hz(75.0, 1500.0, 0.1, 50.0) == Approx(5.0));
  CHECK(ping_rate_hz(7.5, 1500.0, 0.0, 50.0) == 50.0);
}

TEST_CASE("at the highest speed every feature has its pings; faster, some have one less") {
  const double rate_hz = 8.0, feature_m = 1.0, width_m = footprint_m(20.0, 0.0175);
  CHECK(width_m == Approx(0.35).epsilon(1e-3));
  for (const int pings : {1, 3, 5}) {
    const double speed_mps = fastest_for_feature_mps(feature_m, width_m, rate_hz, pings);
    const auto fewest_pings_on = [&](double v_mps) {  // over where the first ping falls
      int least = 1000;
      for (int phase = 0; phase < 200; ++phase) {
        int pings_on = 0;
        for (int k = -100; k < 100; ++k) {
          const double x = (k + phase / 200.0) * v_mps / rate_hz;
          pings_on += x >= -0.5 * width_m && x < feature_m + 0.5 * width_m;
        }
        least = std::min(least, pings_on);
      }
      return least;
    };
    CHECK(fewest_pings_on(speed_mps * (1.0 - 1e-9)) == pings);
    CHECK(fewest_pings_on(speed_mps * 1.02) == pings - 1);
  }
}

TEST_CASE("soundings across a feature") {
  CHECK(soundings_across(1.0, 0.25) == 4);
  CHECK(soundings_across(1.0, 0.3) == 3);
}
