#include "kernels/acoustics/array/line.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

using namespace ensonify::array;
using Catch::WithinAbs;
constexpr double kDeg = std::numbers::pi / 180.0;

TEST_CASE("a uniform line is 50.76 lambda/L degrees wide") {
  CHECK_THAT(half_power_width_rad(100.0) / kDeg * 100.0, WithinAbs(50.76, 0.01));
  CHECK_THAT(line_power(100.0, half_power_half_width(100.0)), WithinAbs(0.5, 1e-9));
  CHECK(half_power_width_rad(length_in_waves_for(1.0 * kDeg)) == Approx(1.0 * kDeg));
}

TEST_CASE("its sidelobes are -13.26, -17.83 and -20.79 dB") {
  const double levels[] = {-13.26, -17.83, -20.79};
  for (int lobe = 1; lobe <= 3; ++lobe) {
    double peak = 0.0;
    for (double x = lobe; x < lobe + 1; x += 1e-4) peak = std::max(peak, line_power(1.0, x));
    CHECK_THAT(10 * std::log10(peak), WithinAbs(levels[lobe - 1], 0.01));
    CHECK(line_power(1.0, lobe) < 1e-30);
  }
}

TEST_CASE("two-way it is 36.55 lambda/L degrees wide, first sidelobe -26.52 dB") {
  CHECK_THAT(std::pow(line_power(100.0, std::sin(0.5 * 36.55 / 100 * kDeg)), 2), WithinAbs(0.5, 1e-3));
}

TEST_CASE("the pattern's integral over sine is lambda/L, its square's two thirds of that") {
  double one_way = 0.0, two_way = 0.0;
  const double step = 1e-5;
  for (double s = -1 + step / 2; s < 1; s += step) {
    one_way += line_power(200.0, s) * step;
    two_way += std::pow(line_power(200.0, s), 2) * step;
  }
  CHECK(one_way == Approx(equivalent_width(200.0)).epsilon(1.1e-3));  // the tails beyond +-1 hold 1/(pi^2 200) of it
  CHECK(two_way == Approx(2.0 / 3.0 * equivalent_width(200.0)).epsilon(1e-5));
  CHECK(equivalent_width(100.0) == Approx(1.1288 * half_power_width_rad(100.0)).epsilon(1e-4));
}

TEST_CASE("a steered beam broadens as 1/cos, within 0.25 % at 70 degrees") {
  const double width = half_power_width_rad(100.0, 70 * kDeg);
  CHECK(width == Approx(half_power_width_rad(100.0) / std::cos(70 * kDeg)).epsilon(2.5e-3));
  CHECK(line_power(100.0, std::sin(70 * kDeg), std::sin(70 * kDeg)) == 1.0);
}
