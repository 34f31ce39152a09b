#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "kernels/seabed/backscatter.h"

using namespace ensonify::seabed;
using Catch::WithinAbs;

TEST_CASE("at normal incidence the strength is mu, at 30 degrees grazing 6.02 dB less") {
  CHECK(10 * std::log10(lambert_backscatter(-25, 1.0)) == Approx(-25));
  CHECK_THAT(lambert_strength_db(-25, 0.5), WithinAbs(-31.0206, 1e-4));
}

TEST_CASE("a surface of mu = -4.97 dB returns exactly what falls on it") {
  // Bistatic Lambert: mu sin(in) sin(out). Scattered / incident power per area = Integral mu sin(in) sin^.. dOmega /
  // sin(in).
  double sum = 0.0;
  const int n = 2000;
  for (int i = 0; i < n; ++i) {
    const double grazing = (i + 0.5) * std::numbers::pi / 2 / n;
    const double mu = lambert_backscatter(-4.97, std::sin(grazing)) / std::pow(std::sin(grazing), 2);
    sum += mu * std::sin(grazing) * 2 * std::numbers::pi * std::cos(grazing) * (std::numbers::pi / 2 / n);
  }
  CHECK(sum == Approx(1.0).epsilon(1e-3));
}
