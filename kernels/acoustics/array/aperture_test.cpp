#include "kernels/acoustics/array/aperture.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

using namespace ensonify::array;
using Catch::WithinAbs;
using ensonify::frames::Vec3;

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDeg = kPi / 180.0;

double db(double amplitude) { return 20.0 * std::log10(std::abs(amplitude)); }

}  // namespace

TEST_CASE("a piston's width is 58.96 lambda/D deg, 42.32 two-way, first lobe -17.57 dB") {
  const double D = 100.0;
  const auto edge = [&](double level_db) {  // sine at which the one-way pattern has fallen so far
    double low = 0.0, high = 1.0 / D;
    for (int i = 0; i < 60; ++i)
      (db(piston_amplitude(D, 0.5 * (low + high))) > level_db ? low : high) = 0.5 * (low + high);
    return low;
  };
  const double half_power_db = 10.0 * std::log10(0.5);
  CHECK_THAT(2.0 * edge(half_power_db) / kDeg * D, WithinAbs(58.96, 0.01));
  CHECK_THAT(2.0 * edge(0.5 * half_power_db) / kDeg * D, WithinAbs(42.32, 0.01));

  const double first_null = 1.21967 / D;  // x = 3.83171, the first zero of J1
  CHECK(std::abs(piston_amplitude(D, first_null)) < 1e-5);
  double highest = 0.0;
  for (double s = first_null; s < 2.2 / D; s += 1e-4 / D) highest = std::max(highest, std::abs(piston_amplitude(D, s)));
  CHECK_THAT(db(highest), WithinAbs(-17.57, 0.005));
  CHECK(piston_amplitude(D, 0.0) == 1.0);
  CHECK(piston_amplitude(D, -0.003) == piston_amplitude(D, 0.003));
}

TEST_CASE("a piston's directivity is (pi D / lambda)^2") {
  // 2 / integral of the power over the cosine: the factor of a baffled piston without back radiation, for large D.
  const double D = 30.0;
  double integral = 0.0;
  const int steps = 20000;
  for (int i = 0; i < steps; ++i) {
    const double angle = 0.5 * kPi * (i + 0.5) / steps;
    integral += std::pow(piston_amplitude(D, std::sin(angle)), 2) * std::sin(angle) * 0.5 * kPi / steps;
  }
  CHECK(2.0 / integral == Approx(std::pow(kPi * D, 2)).epsilon(0.01));  // [1 - J1(2 pi D)/(pi D)]: within 0.1 % at 30
}

TEST_CASE("a plane array is the product of its lines in both direction cosines") {
  const LineArray x{.spacing_m = 0.5, .weights = shading_weights({}, 100)};
  const LineArray y{.spacing_m = 0.5, .weights = shading_weights({.window = Shading::Window::kHann}, 20)};
  const PlanarArray array{.along_x = x, .along_y = y};
  const Vec3 direction(0.02, 0.4, std::sqrt(1.0 - 0.02 * 0.02 - 0.4 * 0.4));
  const auto product = amplitude(x, 1.0, 0.02) * amplitude(y, 1.0, 0.4, 0.35);
  CHECK(std::abs(amplitude(array, 1.0, direction, 0.0, 0.35) - product) < 1e-15);
  // Where one line has a null, the whole has one, whatever the other cosine: the beam is a cone, not a plane.
  const double null = 1.0 / 50.0;
  for (const double v : {0.0, 0.5, 0.9}) {
    CHECK(std::abs(amplitude(array, 1.0, {null, v, std::sqrt(1 - null * null - v * v)}, 0.0, v)) < 1e-12);
  }
}

TEST_CASE("a face attenuates off its normal, and behind it by the baffle's loss") {
  CHECK(Face().amplitude(0.3) == 1.0);
  CHECK(Face().amplitude(-0.3) == 1.0);
  const Face soft(1.0, 20.0);
  CHECK(soft.amplitude(1.0) == 1.0);
  CHECK(soft.amplitude(0.5) == Approx(0.5));
  CHECK(db(soft.amplitude(-0.5)) == Approx(db(0.5) - 20.0));
  CHECK(soft.amplitude(0.0) == 0.0);
}
