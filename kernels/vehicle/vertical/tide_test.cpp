#include "kernels/vehicle/vertical/tide.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <string>

using namespace ensonify::vertical;
constexpr double kPi = std::numbers::pi;

namespace {

double radps(const char* name) { return *constituent_speed_degph(name) * kPi / 180.0 / 3600.0; }
double speed(const char* name) { return constituent_speed_degph(name).value(); }

}  // namespace

TEST_CASE("compound tides have the sums of the speeds they are made of") {
  // The list gives seven decimals, so sums agree to a few of the last.
  CHECK(speed("M4") == Approx(2 * speed("M2")).margin(3e-7));
  CHECK(speed("M6") == Approx(3 * speed("M2")).margin(3e-7));
  CHECK(speed("MS4") == Approx(speed("M2") + speed("S2")).margin(3e-7));
  CHECK(speed("MN4") == Approx(speed("M2") + speed("N2")).margin(3e-7));
  CHECK(speed("MK3") == Approx(speed("M2") + speed("K1")).margin(3e-7));
  CHECK(speed("MO3") == Approx(speed("M2") + speed("O1")).margin(3e-7));
  CHECK(speed("2SM2") == Approx(2 * speed("S2") - speed("M2")).margin(3e-7));
  CHECK(speed("MSF") == Approx(speed("S2") - speed("M2")).margin(3e-7));
  CHECK(speed("MM") == Approx(speed("M2") - speed("N2")).margin(3e-7));
  CHECK(speed("MU2") == Approx(speed("M4") - speed("S2")).margin(3e-7));
}

TEST_CASE("speeds are those of the sun's and the moon's mean motions") {
  // Degrees per mean solar hour [Schureman1958, table 1]: sun's hour angle, moon, sun, lunar perigee.
  const double T = 15.0, s = 0.54901653, h = 0.04106864, p = 0.00464183;
  CHECK(speed("M2") == Approx(2 * T - 2 * s + 2 * h).margin(1e-6));
  CHECK(speed("N2") == Approx(2 * T - 3 * s + 2 * h + p).margin(1e-6));
  CHECK(speed("L2") == Approx(2 * T - s + 2 * h - p).margin(1e-6));
  CHECK(speed("2N2") == Approx(2 * T - 4 * s + 2 * h + 2 * p).margin(1e-6));
  CHECK(speed("NU2") == Approx(2 * T - 3 * s + 4 * h - p).margin(1e-6));
  CHECK(speed("K2") == Approx(2 * T + 2 * h).margin(1e-6));
  CHECK(speed("T2") == Approx(2 * T - h).margin(3e-6));  // and the sun's perigee, 0.000002
  CHECK(speed("K1") == Approx(T + h).margin(1e-6));
  CHECK(speed("O1") == Approx(T - 2 * s + h).margin(1e-6));
  CHECK(speed("P1") == Approx(T - h).margin(1e-6));
  CHECK(speed("Q1") == Approx(T - 3 * s + h + p).margin(1e-6));
  CHECK(speed("J1") == Approx(T + s + h - p).margin(1e-6));
  CHECK(speed("OO1") == Approx(T + 2 * s + h).margin(1e-6));
  CHECK(speed("SSA") == Approx(2 * h).margin(1e-6));
  CHECK(speed("M3") == Approx(1.5 * speed("M2")).margin(1e-6));
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
  CHECK(highest - lowest == Approx(2.0).margin(0.03));  // 2 (1.5 - 0.5), a little more half a tide from neaps
}

TEST_CASE("the phase is how long after the reference time high water comes") {
  const Tide tide(HarmonicTide{0.0, {{radps("M2"), 1.0, kPi / 2}}});
  CHECK(tide.at(12.4206 / 4 * 3600).height_m == Approx(1.0).margin(1e-6));
}

TEST_CASE("rates are derivatives of levels, and accelerations of rates") {
  const Tide harmonic(HarmonicTide{1.0, {{radps("M2"), 1.5, 0.3}, {radps("K1"), 0.4, 2.0}}});
  const Tide gauge(GaugeReadings{{{0.0, 1.0}, {600.0, 1.3}, {1200.0, 1.1}, {1500.0, 1.1}}});
  for (const Tide* tide : {&harmonic, &gauge}) {
    for (const double t : {1.0, 599.0, 700.0, 1300.0, 1600.0, 1799.0, 2000.0}) {
      const Level before = tide->at(t - 0.5), now = tide->at(t), after = tide->at(t + 0.5);
      CAPTURE(t);
      CHECK(now.rate_mps == Approx(after.height_m - before.height_m).margin(1e-9));
      CHECK(now.acceleration_mps2 == Approx(after.rate_mps - before.rate_mps).margin(1e-9));
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
    CHECK(tide.at(reading_s - 1e-6).rate_mps == Approx(tide.at(reading_s + 1e-6).rate_mps).margin(1e-10));
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
  CHECK(line.at(30.0).acceleration_mps2 == Approx(0.0).margin(1e-15));
}
