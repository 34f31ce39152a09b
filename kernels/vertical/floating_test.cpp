#include "kernels/vertical/floating.h"

#include <catch2/catch.hpp>
#include <cmath>

using namespace ensonify::vertical;

namespace {

const Tide kTide(HarmonicTide{2.0, {{1.405189e-4, 1.5, 0.3}}});  // M2
const Loading kLoading{{{0, 0.0}, {2, 0.03}, {6, 0.2}}, 0.02, -1e-6};

/// A hull that speeds up and slows down all the time.
double speed_mps(double t_s) { return 3.0 + 2.5 * std::sin(0.1 * t_s); }

}  // namespace

TEST_CASE("a vessel that goes on as she does floats on the tide less her sinkage") {
  Floating hull(kTide, kLoading, 4.0, 100.0);
  CHECK(hull.at_last().height_m == Approx(kTide.at(100.0).height_m - sinkage_m(kLoading, 4.0, 100.0)));
  hull.advance(4.0, 400.0);
  CHECK(hull.at_last().height_m == Approx(kTide.at(400.0).height_m - sinkage_m(kLoading, 4.0, 400.0)));
  CHECK(hull.at_last().rate_mps == Approx(kTide.at(400.0).rate_mps + 1e-6));
}

TEST_CASE("what does not float rides the tide alone") {
  Floating diver(kTide, std::nullopt, 1.0, 0.0);
  diver.advance(3.0, 50.0);
  CHECK(diver.at_last().height_m == kTide.at(50.0).height_m);
  CHECK(diver.at_last().rate_mps == kTide.at(50.0).rate_mps);
}

TEST_CASE("600 s of a vessel's vertical acceleration, asked for at 50 Hz, integrate to where she floats") {
  Floating hull(kTide, kLoading, speed_mps(0.0), 0.0);
  constexpr double h = 0.02;
  Afloat before = hull.at_last();
  double height_m = before.height_m, rate_mps = before.rate_mps;
  for (int i = 1; i <= 30000; ++i) {
    hull.advance(speed_mps(i * h), i * h);
    const Afloat now = hull.at_last();
    // The trapezoidal rule, and the double integral of a straight line. The jerk is 1e-3 m/s^3: 1e-8 m/s a step.
    height_m += h * rate_mps + h * h / 6 * (2 * before.acceleration_mps2 + now.acceleration_mps2);
    rate_mps += 0.5 * h * (before.acceleration_mps2 + now.acceleration_mps2);
    before = now;
  }
  CHECK(height_m == Approx(before.height_m).margin(1e-4));
  CHECK(rate_mps == Approx(before.rate_mps).margin(1e-6));
}
