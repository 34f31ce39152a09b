#include "kernels/vehicle/vertical/floating.h"

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

namespace {

/// How far 600 s of vertical acceleration, asked for at 50 Hz from t = 0, are from where the hull floats then.
Level miss_after_600_s(Floating hull, double (*speed_at)(double)) {
  constexpr double h = 0.02;
  Level before = hull.at_last(), summed = before;
  for (int i = 1; i <= 30000; ++i) {
    hull.advance(speed_at(i * h), i * h);
    const Level now = hull.at_last();
    // The trapezoidal rule, and the double integral of a straight line. The jerk is 1e-3 m/s^3: 1e-8 m/s a step.
    summed.height_m += h * summed.rate_mps + h * h / 6 * (2 * before.acceleration_mps2 + now.acceleration_mps2);
    summed.rate_mps += 0.5 * h * (before.acceleration_mps2 + now.acceleration_mps2);
    before = now;
  }
  return {summed.height_m - before.height_m, summed.rate_mps - before.rate_mps};
}

}  // namespace

TEST_CASE("600 s of a vessel's vertical acceleration at 50 Hz integrate to where she floats") {
  const Level miss = miss_after_600_s(Floating(kTide, kLoading, speed_mps(0.0), 0.0), speed_mps);
  CHECK(std::abs(miss.height_m) < 1e-4);
  CHECK(std::abs(miss.rate_mps) < 1e-6);
}

TEST_CASE("on a gauge's tide they integrate too, from any start, at readings of 1 or 6 min") {
  for (const double interval_s : {360.0, 60.0}) {
    for (const double begun_s : {0.0, 0.01, 123.4}) {  // between two values that are asked for; anywhere
      GaugeReadings readings;                          // to centimetres, which bends the level more than the tide does
      for (double t = -begun_s - 10 * interval_s; t < 1200.0; t += interval_s) {
        readings.time_s_and_height_m.emplace_back(t, 0.01 * std::round(100.0 * kTide.at(t + 9000.0).height_m));
      }
      const Tide gauge(readings);
      const auto still = [](double) { return 0.0; };
      for (const Level& miss : {miss_after_600_s(Floating(gauge, kLoading, speed_mps(0.0), 0.0), speed_mps),
                                miss_after_600_s(Floating(gauge, std::nullopt, 0.0, 0.0), still)}) {
        CAPTURE(interval_s, begun_s, miss.height_m, miss.rate_mps);
        CHECK(std::abs(miss.height_m) < 1e-3);
      }
    }
  }
}
