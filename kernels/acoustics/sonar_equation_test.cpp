#include "kernels/acoustics/sonar_equation.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "kernels/seabed/backscatter.h"

using namespace ensonify;
using namespace ensonify::sonar_equation;
using Catch::WithinAbs;

namespace {
constexpr double kDeg = std::numbers::pi / 180.0;
constexpr double kSpeed = 1500.0;  // m/s
constexpr double kPulse = 100e-6;  // s

double sidescan_level_db(double range_m) {
  constexpr double kAltitude = 10.0;
  const double area_m2 = sidescan_area_m2(range_m, kAltitude, kTwoWayWidth * 0.5 * kDeg, kSpeed, kPulse);
  return seabed_level_db(210, {range_m, 0.1}, seabed::lambert_strength_db(-25, kAltitude / range_m), area_m2);
}

double multibeam_level_db(double beam_deg) {
  const double cosine = std::cos(beam_deg * kDeg);
  const double width_rad = kOneWayWidth * kDeg;
  const double range_m = 20.0 / cosine;
  const double area_m2 = multibeam_area_m2(range_m, beam_deg * kDeg, width_rad, width_rad, kSpeed, kPulse);
  return seabed_level_db(220, {range_m, 0.07}, seabed::lambert_strength_db(-25, cosine), area_m2);
}
}  // namespace

TEST_CASE("a sidescan receives what the area integral over the seabed gives") {
  // Numerical integrals of the sonar equation: SL 210, 100 us, 0.5 deg, 0.1 dB/m, 10 m above a Lambert seabed of -25
  // dB.
  CHECK_THAT(sidescan_level_db(20), WithinAbs(103.50, 0.01));
  CHECK_THAT(sidescan_level_db(50), WithinAbs(77.06, 0.01));
  CHECK_THAT(sidescan_level_db(100), WithinAbs(51.95, 0.01));
}

TEST_CASE("a multibeam's level is the area integral's, or slightly more") {
  // Numerical integrals: SL 220, 100 us, 1 x 1 deg, 0.07 dB/m, 20 m above the same seabed.
  CHECK_THAT(multibeam_level_db(45), WithinAbs(117.65, 0.1));
  CHECK_THAT(multibeam_level_db(60), WithinAbs(107.68, 0.1));
  for (const auto& [beam_deg, level_db] : {std::pair{0.0, 131.86}, {30.0, 124.20}}) {
    CHECK(multibeam_level_db(beam_deg) >= level_db);
    CHECK(multibeam_level_db(beam_deg) <= level_db + 0.25);  // the bound of 1.2 dB belongs to 10 degrees
  }
  CHECK(multibeam_level_db(-45) == multibeam_level_db(45));
}

TEST_CASE("a sidescan's strip is R psi (c tau / 2) / cos(grazing), a disc's slice at nadir") {
  const double grazing = std::asin(10.0 / 50.0);
  CHECK(sidescan_area_m2(50, 10, 0.01, kSpeed, kPulse) == Approx(50 * 0.01 * 0.075 / std::cos(grazing)).epsilon(1e-4));
  CHECK(sidescan_area_m2(10, 10, 0.01, kSpeed, kPulse) == Approx(10 * 0.01 * std::sqrt(2 * 10 * 0.0375)).epsilon(1e-3));
  CHECK(sidescan_area_m2(9.9, 10, 0.01, kSpeed, kPulse) == 0.0);
  CHECK(seabed_level_db(210, {9.9}, -25, 0.0) == -std::numeric_limits<double>::infinity());
}

TEST_CASE("targets lose 12 dB per doubled range, volume 6 dB, both what bubbles take") {
  const auto target = [](double range_m) { return target_level_db(200, {range_m}, -20); };
  const auto volume = [](double range_m) { return volume_level_db(200, {range_m}, -70, 1e-3, kSpeed, kPulse); };
  CHECK_THAT(target(10) - target(20), WithinAbs(12.04, 0.005));
  CHECK_THAT(volume(10) - volume(20), WithinAbs(6.02, 0.005));
  CHECK(target(1) == Approx(180));
  CHECK(target_level_db(200, {20, 0.0, 3.0}, -20) == Approx(target(20) - 6.0));
  // One pulse-long shell of all directions at 1 m: 4 pi x 0.075 m^3 of -70 dB.
  CHECK(volume_level_db(200, {1}, -70, 4 * std::numbers::pi, kSpeed, kPulse) ==
        Approx(130 + 10 * std::log10(4 * std::numbers::pi * 0.075)));
}
