#include <catch2/catch.hpp>
#include <cmath>

#include "kernels/vehicle/vertical/floating.h"

using namespace ensonify::vertical;
using Catch::WithinAbs;

TEST_CASE("a sudden settlement is come to as the step response says") {
  Settling hull(0.0);
  hull.advance(0.1, 1e-9);  // as good as at once
  for (int i = 0; i < 4; ++i) hull.advance(0.1, 1.0);
  CHECK(hull.lower_m() == Approx(0.1 * (1.0 - 5.0 * std::exp(-4.0))));  // 1 - (1 + w t) exp(-w t), 0.908
  CHECK(hull.rate_mps() == Approx(0.1 * 4.0 * std::exp(-4.0)));         // w^2 t exp(-w t)
}

TEST_CASE("a ramp is followed 2 k / w behind, however it is divided into steps") {
  Settling once(0.02), often(0.02);
  once.advance(0.12, 10.0);
  for (int i = 1; i <= 1000; ++i) often.advance(0.02 + 1e-4 * i, 0.01);
  CHECK(often.lower_m() == Approx(once.lower_m()).epsilon(1e-12));
  CHECK(often.rate_mps() == Approx(once.rate_mps()).epsilon(1e-12));
  CHECK(once.lower_m() == Approx(0.12 - 2.0 * 0.01).epsilon(1e-3));  // but for 12 exp(-10) of it
  CHECK(once.rate_mps() == Approx(0.01).epsilon(1e-3));
}

TEST_CASE("rate and acceleration are derivatives, through the beginning of a ramp too") {
  Settling hull(0.0);
  const auto target_m = [](double t_s) { return t_s < 1.0 ? 0.0 : 0.01 * (t_s - 1.0); };
  constexpr double kStep_s = 1e-3;
  double lower_m = 0.0, rate_mps = 0.0;
  for (int i = 1; i <= 3000; ++i) {
    const double before_mps = hull.rate_mps(), before_mps2 = hull.acceleration_mps2();
    hull.advance(target_m(i * kStep_s), kStep_s);
    // The trapezoid errs by the third derivative times h^3 / 12: 1e-12 m a step at the most.
    lower_m += 0.5 * kStep_s * (before_mps + hull.rate_mps());
    rate_mps += 0.5 * kStep_s * (before_mps2 + hull.acceleration_mps2());
  }
  CHECK_THAT(lower_m, WithinAbs(hull.lower_m(), 1e-8));
  CHECK_THAT(rate_mps, WithinAbs(hull.rate_mps(), 1e-8));
  CHECK(hull.lower_m() > 1e-3);
}
