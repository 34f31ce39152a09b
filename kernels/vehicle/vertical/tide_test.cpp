#include "kernels/vehicle/vertical/tide.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <string>

using namespace ensonify::vertical;
using Catch::WithinAbs;
constexpr double kPi = std::numbers::pi;

namespace {

double radps(const char* name) { return *constituent_speed_degph(name) * kPi / 180.0 / 3600.0; }
double speed(const char* name) { return constituent_speed_degph(name).value(); }

}  // namespace

TEST_CASE("compound tides have the sums of the speeds they are made of") {
  // The list gives seven decimals, so sums agree to a few of the last.
  CHECK_THAT(speed("M4"), WithinAbs(2 * speed("M2"), 3e-7));
  CHECK_THAT(speed("M6"), WithinAbs(3 * speed("M2"), 3e-7));
  CHECK_THAT(speed("MS4"), WithinAbs(speed("M2") + speed("S2"), 3e-7));
  CHECK_THAT(speed("MN4"), WithinAbs(speed("M2") + speed("N2"), 3e-7));
  CHECK_THAT(speed("MK3"), WithinAbs(speed("M2") + speed("K1"), 3e-7));
  CHECK_THAT(speed("MO3"), WithinAbs(speed("M2") + speed("O1"), 3e-7));
  CHECK_THAT(speed("2SM2"), WithinAbs(2 * speed("S2") - speed("M2"), 3e-7));
  CHECK_THAT(speed("MSF"), WithinAbs(speed("S2") - speed("M2"), 3e-7));
  CHECK_THAT(speed("MM"), WithinAbs(speed("M2") - speed("N2"), 3e-7));
  CHECK_THAT(speed("MU2"), WithinAbs(speed("M4") - speed("S2"), 3e-7));
}

TEST_CASE("speeds are those of the sun's and the moon's mean motions") {
  // Degrees per mean solar hour [Schureman1958, table 1]: sun's hour angle, moon, sun, lunar perigee.
  const double T = 15.0, s = 0.54901653, h = 0.04106864, p = 0.00464183;
  CHECK_THAT(speed("M2"), WithinAbs(2 * T - 2 * s + 2 * h, 1e-6));
  CHECK_THAT(speed("N2"), WithinAbs(2 * T - 3 * s + 2 * h + p, 1e-6));
  CHECK_THAT(speed("L2"), WithinAbs(2 * T - s + 2 * h - p, 1e-6));
  CHECK_THAT(speed("2N2"), WithinAbs(2 * T - 4 * s + 2 * h + 2 * p, 1e-6));
  CHECK_THAT(speed("NU2"), WithinAbs(2 * T - 3 * s + 4 * h - p, 1e-6));
  CHECK_THAT(speed("K2"), WithinAbs(2 * T + 2 * h, 1e-6));
  CHECK_THAT(speed("T2"), WithinAbs(2 * T - h, 3e-6));  // and the sun's perigee, 0.000002
  CHECK_THAT(speed("K1"), WithinAbs(T + h, 1e-6));
  CHECK_THAT(speed("O1"), WithinAbs(T - 2 * s + h, 1e-6));
  CHECK_THAT(speed("P1"), WithinAbs(T - h, 1e-6));
  CHECK_THAT(speed("Q1"), WithinAbs(T - 3 * s + h + p, 1e-6));
  CHECK_THAT(speed("J1"), WithinAbs(T + s + h - p, 1e-6));
  CHECK_THAT(speed("OO1"), WithinAbs(T + 2 * s + h, 1e-6));
  CHECK_THAT(speed("SSA"), WithinAbs(2 * h, 1e-6));
  CHECK_THAT(speed("M3"), WithinAbs(1.5 * speed("M2"), 1e-6));
}

TEST_CASE("every name in the list of names has a speed") {
  const std::string names(constituent_names());
  std::size_t at = 0, count = 0;
  while (at < names.size()) {
    const std::size_t end = std::min(names.find(", ", at), names.size());
    CHECK(constituent_speed_degph(names.substr(at, end - at)).has_value());
    at = end + 2;
    ++count;
  }
  CHECK(count == 29);
  CHECK_FALSE(constituent_speed_degph("M7").has_value());
}

TEST_CASE("springs and neaps: M2 and S2 beat in 14.77 days") {
  const Tide tide(HarmonicTide{2.0, {{radps("M2"), 1.5, 0.0}, {radps("S2"), 0.5, 0.0}}});
  CHECK(tide.at(0.0).height_m == Approx(4.0));
  const double neap_s = 0.5 * 2 * kPi / (radps("S2") - radps("M2"));
  CHECK(neap_s / 86400.0 == Approx(14.7653 / 2).epsilon(1e-4));
  double highest = 0.0, lowest = 10.0;
  for (double t = -6.3; t < 6.3; t += 0.05) {
    const double level = tide.at(neap_s + t * 3600.0).height_m;
    highest = std::max(highest, level);
    lowest = std::min(lowest, level);
  }
  CHECK_THAT(highest - lowest, WithinAbs(2.0, 0.03));  // 2 (1.5 - 0.5), a little more half a tide from neaps
}

TEST_CASE("the phase is how long after the reference time high water comes") {
  const Tide tide(HarmonicTide{0.0, {{radps("M2"), 1.0, kPi / 2}}});
  CHECK_THAT(tide.at(12.4206 / 4 * 3600).height_m, WithinAbs(1.0, 1e-6));
}

TEST_CASE("rates are derivatives of levels, and accelerations of rates") {
  const Tide harmonic(HarmonicTide{1.0, {{radps("M2"), 1.5, 0.3}, {radps("K1"), 0.4, 2.0}}});
  const Tide gauge(GaugeReadings{{{0.0, 1.0}, {600.0, 1.3}, {1200.0, 1.1}, {1500.0, 1.1}}});
  for (const Tide* tide : {&harmonic, &gauge}) {
    for (const double t : {1.0, 599.0, 700.0, 1300.0, 1600.0, 1799.0, 2000.0}) {
      const Level before = tide->at(t - 0.5), now = tide->at(t), after = tide->at(t + 0.5);
      CAPTURE(t);
      CHECK_THAT(now.rate_mps, WithinAbs(after.height_m - before.height_m, 1e-9));
      CHECK_THAT(now.acceleration_mps2, WithinAbs(after.rate_mps - before.rate_mps, 1e-9));
    }
  }
  CHECK(Tide(0.7).at(5.0).rate_mps == 0.0);
  CHECK(Tide(0.7).at(5.0).acceleration_mps2 == 0.0);
}

TEST_CASE("a gauge's readings are interpolated smoothly, constant before and after them") {
  const Tide tide(GaugeReadings{{{0.0, 1.0}, {600.0, 1.3}, {1200.0, 1.1}}});
  CHECK(tide.at(-10.0).height_m == 1.0);
  CHECK(tide.at(-10.0).rate_mps == 0.0);
  CHECK(tide.at(0.0).height_m == 1.0);
  CHECK(tide.at(600.0).height_m == Approx(1.3));
  CHECK(tide.at(1200.0).height_m == Approx(1.1));
  for (const double reading_s : {600.0, 1200.0, 1800.0}) {
    CHECK_THAT(tide.at(reading_s - 1e-6).rate_mps, WithinAbs(tide.at(reading_s + 1e-6).rate_mps, 1e-10));
  }
  CHECK(tide.at(1800.0).height_m == 1.1);  // at rest one interval behind the last
  CHECK(tide.at(5000.0).height_m == 1.1);
  CHECK(tide.at(5000.0).rate_mps == 0.0);
  CHECK(tide.last_s() == 1200.0);
  CHECK(tide.first_s() == 0.0);
  CHECK(Tide(GaugeReadings{{{7.0, 1.4}}}).at(9.0).height_m == 1.4);
  CHECK(std::isinf(Tide(1.0).last_s()));
  CHECK_THROWS_WITH(Tide(GaugeReadings{}), "tide: no readings");
  CHECK_THROWS_WITH(Tide(GaugeReadings{{{0, 1}, {0, 2}}}), "tide: times of readings must rise");
}

TEST_CASE("a tide read every six minutes is followed within 0.01 mm but at the ends") {
  const Tide truth(HarmonicTide{2.0, {{radps("M2"), 1.5, 0.3}, {radps("S2"), 0.5, 1.0}}});
  GaugeReadings readings;
  for (double t = 0.0; t <= 86400.0; t += 360.0) readings.time_s_and_height_m.emplace_back(t, truth.at(t).height_m);
  const Tide gauge(readings);
  double ends_m = 0.0, within_m = 0.0;
  for (double t = 0.0; t <= 86400.0; t += 5.0) {
    double& off_m = t < 360.0 || t > 86040.0 ? ends_m : within_m;
    off_m = std::max(off_m, std::abs(gauge.at(t).height_m - truth.at(t).height_m));
  }
  CAPTURE(within_m, ends_m);
  CHECK(within_m < 1e-5);
  CHECK(ends_m < 5e-4);  // the curvature, 4e-8 m/s^2 at most, times h^2 / 12
  const Tide line(GaugeReadings{{{0.0, 1.0}, {180.0, 1.9}}});
  CHECK(line.at(30.0).height_m == Approx(1.15));
  CHECK_THAT(line.at(30.0).acceleration_mps2, WithinAbs(0.0, 1e-15));
}
