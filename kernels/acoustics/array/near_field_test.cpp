#include "kernels/acoustics/array/near_field.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

using namespace ensonify::array;
using Catch::WithinAbs;

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kWavelength_m = 0.005;

/// 0.5 m long, 50 m near-field range; touching elements of a tenth of a wavelength stand for a continuous line.
LineArray long_line() {
  return {.spacing_m = 0.0005, .weights = shading_weights({}, 1000), .element_length_m = 0.0005};
}

double db(double power) { return 10.0 * std::log10(power); }

/// Of the part around the axis.
BeamEdges near_field_half_power_edges(const LineArray& array, double wavelength_m, double sin_steer, double range_m,
                                      double focus_m = kFarAway_m) {
  const auto pattern = [&](double u) {
    return std::norm(near_field_amplitude(array, wavelength_m, u, sin_steer, range_m, focus_m));
  };
  return half_power_edges(pattern, sin_steer, std::min(0.01, wavelength_m / (64.0 * array.length_m())));
}

/// With the exact distances instead of Fresnel's.
double exact_power(const LineArray& line, double sine, double sin_steer, double range_m, double focus_m) {
  const auto path = [](double x, double u, double r) {
    return x * (x - 2.0 * r * u) / (r + std::sqrt(r * r - 2.0 * r * x * u + x * x));
  };
  std::complex<double> sum = 0.0;
  for (int n = 0; n < line.elements(); ++n) {
    const double x = line.spacing_m * (n - 0.5 * (line.elements() - 1));
    sum += std::polar(1.0, -2.0 * kPi / kWavelength_m * (path(x, sine, range_m) - path(x, sin_steer, focus_m)));
  }
  return std::norm(sum) / (line.elements() * static_cast<double>(line.elements()));
}

}  // namespace

TEST_CASE("on the axis an unfocused line loses what Fresnel's integrals say") {
  // |C(v) - i S(v)| / v with v = L / sqrt(2 lambda R). C and S: [Abramowitz1964], table 7.7.
  struct Row {
    double v, C, S;
  };
  const Row rows[] = {{0.5, 0.4923442, 0.0647324},
                      {0.7, 0.6596524, 0.1721365},
                      {1.0, 0.7798934, 0.4382591},
                      {1.5, 0.4452612, 0.6975050},
                      {2.0, 0.4882534, 0.3434157}};
  const LineArray line = long_line();
  const double L = line.length_m();
  for (const Row& row : rows) {
    const double range_m = L * L / (2.0 * kWavelength_m * row.v * row.v);
    const std::complex<double> expected = std::complex<double>(row.C, -row.S) / row.v;
    const std::complex<double> got = near_field_amplitude(line, kWavelength_m, 0.0, 0.0, range_m);
    INFO("v = " << row.v);
    CHECK_THAT(got.real(), WithinAbs(expected.real(), 3e-6));  // 1000 elements for a continuous line: 2.1e-6 at v = 2
    CHECK_THAT(got.imag(), WithinAbs(expected.imag(), 3e-6));
    CHECK(std::abs(near_field_amplitude(line, kWavelength_m, 0.0, 0.0, range_m, range_m)) == Approx(1.0));
  }
}

TEST_CASE("the loss at L^2 / lambda, half and a quarter of it is 0.24, 0.97 and 4.0 dB") {
  const LineArray line = long_line();
  const double range_m = near_field_range_m(line, kWavelength_m);
  CHECK(range_m == Approx(50.0));
  // |C - i S| / v at v = 1/sqrt 2, 1 and sqrt 2.
  const auto loss = [&](double r) { return -db(std::norm(near_field_amplitude(line, kWavelength_m, 0.0, 0.0, r))); };
  CHECK_THAT(loss(range_m), WithinAbs(0.239, 0.001));
  CHECK_THAT(loss(range_m / 2), WithinAbs(0.967, 0.001));
  CHECK_THAT(loss(range_m / 4), WithinAbs(4.037, 0.001));
  CHECK_THAT(loss(1e6), WithinAbs(0.0, 1e-6));
}

TEST_CASE("focused at the source's range the pattern is that of the far field, steered too") {
  const LineArray line = long_line();
  for (const double steer : {0.0, 0.5, 0.9}) {
    for (const double range_m : {3.0, 10.0, 60.0}) {
      // Off the axis 1 - u^2 differs from 1 - u0^2; at the half-power edge that is (L/2)^2 k 2 u0 0.44 lambda / L / 2R.
      const double far = half_power_edges(line, kWavelength_m, steer).upper_sine - steer;
      const double near = near_field_half_power_edges(line, kWavelength_m, steer, range_m, range_m).upper_sine - steer;
      CHECK(near == Approx(far).epsilon(5e-3));
      CHECK(std::abs(near_field_amplitude(line, kWavelength_m, steer, steer, range_m, range_m)) ==
            Approx(std::abs(amplitude(line, kWavelength_m, steer, steer))));
    }
  }
}

TEST_CASE("far away near and far field are the same, focusing off") {
  const LineArray line{.spacing_m = 0.0025, .weights = shading_weights({.window = Shading::Window::kTaylor}, 64)};
  for (const double u : {-0.7, 0.0, 0.31, 1.0}) {
    const auto far = amplitude(line, kWavelength_m, u, 0.3);
    const auto near = near_field_amplitude(line, kWavelength_m, u, 0.3, kFarAway_m);
    CHECK_THAT(near.real(), WithinAbs(far.real(), 1e-12));
    CHECK_THAT(near.imag(), WithinAbs(far.imag(), 1e-12));
  }
}

TEST_CASE("in the near field an unfocused beam is as wide as the array, a focused one sharp") {
  const LineArray line = long_line();
  const double range_m = 2.0;  // 1/25 of L^2 / lambda
  const BeamEdges blurred = near_field_half_power_edges(line, kWavelength_m, 0.0, range_m);
  const BeamEdges sharp = near_field_half_power_edges(line, kWavelength_m, 0.0, range_m, range_m);
  // The geometric shadow of the array's end is at u = L / (2 R), where the power is a quarter of that in the open.
  CHECK(blurred.upper_sine == Approx(0.5 * line.length_m() / range_m).epsilon(0.1));
  CHECK(sharp.upper_sine == Approx(0.44295 * kWavelength_m / line.length_m()).epsilon(1e-3));
}

TEST_CASE("Fresnel's approximation agrees with exact distances where it says it does") {
  const LineArray line{.spacing_m = 0.0025, .weights = shading_weights({}, 200)};
  const double limit_m = 0.62 * std::sqrt(std::pow(line.length_m(), 3) / kWavelength_m);  // 3.1 m
  double worst_at_limit = 0.0, worst_far = 0.0;
  for (const double steer : {0.0, 0.3, 0.577, 0.8}) {
    for (double u = steer - 0.02; u <= steer + 0.02; u += 0.001) {
      const auto error = [&](double r) {
        return std::abs(std::norm(near_field_amplitude(line, kWavelength_m, u, steer, r)) -
                        exact_power(line, u, steer, r, 1e9));
      };
      worst_at_limit = std::max(worst_at_limit, error(limit_m));
      worst_far = std::max(worst_far, error(10.0 * limit_m));
    }
  }
  // A cubic phase of pi / 8 at the ends is a quarter of it in the mean, and power changes by at most twice that: 0.196.
  CHECK(worst_at_limit < 0.2);
  CHECK(worst_at_limit > 0.01);  // it is an approximation: this gives that it was not compared with itself
  CHECK(worst_far < 0.002);      // falls as 1 / R^2
}

TEST_CASE("a continuous line in closed form is the sum over its elements") {
  // Elements of a tenth of a wavelength stand for the line: their own pattern is in the sum, and across each the front
  // is taken as straight, which costs (k d / 2)^2 of the 1000 elements' share of the bend, below 1e-6. A front bent by
  // less than 1e-4 counts as straight.
  const LineArray line = long_line();
  for (const double range_m : {2.0, 12.5, 50.0, 1e4, kFarAway_m}) {
    for (const double focus_m : {3.0, 12.5, 40.0, kFarAway_m}) {
      for (double u = -0.1; u <= 0.1; u += 0.00123) {
        const auto sum = near_field_amplitude(line, kWavelength_m, u, 0.0, range_m, focus_m);
        const auto closed = near_field_line_amplitude(line.length_m(), kWavelength_m, u, range_m, focus_m);
        INFO("u " << u << ", range " << range_m << ", focus " << focus_m);
        CHECK(std::abs(sum - closed) < 1e-4);
      }
    }
  }
}

TEST_CASE("Fresnel's integrals have the tabulated values") {
  // [Abramowitz1964], table 7.7: C and S to seven digits.
  const auto at_1 = fresnel_integral(1.0), at_2 = fresnel_integral(2.0), at_5 = fresnel_integral(5.0);
  CHECK_THAT(at_1.real(), WithinAbs(0.7798934, 5e-8));
  CHECK_THAT(at_1.imag(), WithinAbs(0.4382591, 5e-8));
  CHECK_THAT(at_2.real(), WithinAbs(0.4882534, 5e-8));
  CHECK_THAT(at_2.imag(), WithinAbs(0.3434157, 5e-8));
  CHECK_THAT(at_5.real(), WithinAbs(0.5636312, 5e-8));
  CHECK_THAT(at_5.imag(), WithinAbs(0.4991914, 5e-8));
  CHECK(fresnel_integral(-5.0) == -at_5);
  const double edge = 2.0;  // where the series hands over to the fraction
  CHECK(std::abs(fresnel_integral(edge - 1e-13) - fresnel_integral(edge)) < 1e-12);
}
