#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "kernels/acoustics/array/line.h"
#include "kernels/base/random/stream.h"

using namespace ensonify::array;
using Catch::WithinAbs;
using Window = Shading::Window;

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDeg = kPi / 180.0;

LineArray uniform(int elements, double spacing_m) { return {spacing_m, shading_weights({}, elements)}; }

}  // namespace

TEST_CASE("equal point elements give sin(N x) / (N sin x), touching ones a line's sinc") {
  const int N = 40;
  LineArray line = uniform(N, 0.5);
  for (const double u : {-0.93, -0.2, 0.001, 0.0371, 0.5, 0.99}) {
    const double x = kPi * 0.5 * u;
    CHECK_THAT(amplitude(line, 1.0, u).real(), WithinAbs(std::sin(N * x) / (N * std::sin(x)), 1e-13));
    CHECK_THAT(amplitude(line, 1.0, u).imag(), WithinAbs(0.0, 1e-13));
  }
  line.element_length_m = line.spacing_m;
  for (const double u : {-0.93, -0.2, 0.001, 0.0371, 0.5, 0.99}) {
    CHECK_THAT(amplitude(line, 1.0, u).real(), WithinAbs(line_amplitude(20.0, u), 1e-13));
  }
}

TEST_CASE("the same array is narrower at a higher frequency, as 1 / f in sine") {
  const LineArray line = uniform(200, 0.0025);
  const double c = 1500.0;
  for (const double frequency_hz : {100e3, 200e3, 300e3}) {
    const double width = half_power_width_rad(line, c / frequency_hz);
    CHECK_THAT(std::sin(0.5 * width) * line.length_m() * frequency_hz / c, WithinAbs(0.44295, 1e-5));
  }
}

TEST_CASE("a steered beam keeps its width in sine: its edges are those of the exact formula") {
  const LineArray line = uniform(128, 0.5);  // point elements
  for (const double steer_deg : {-70.0, -30.0, 0.0, 45.0, 60.0, 75.0}) {
    const double u0 = std::sin(steer_deg * kDeg);
    const BeamEdges edges = half_power_edges(line, 1.0, u0);
    CHECK_THAT(edges.lower_sine, WithinAbs(u0 - 0.44295 / 64.0, 1e-6));
    CHECK_THAT(edges.upper_sine, WithinAbs(u0 + 0.44295 / 64.0, 1e-6));
    CHECK(power(line, 1.0, u0, u0) == Approx(1.0));
    CHECK(half_power_width_rad(line, 1.0, u0) == Approx(half_power_width_rad(64.0, steer_deg * kDeg)).epsilon(1e-4));
  }
  // Beyond 90 degrees there is nothing: the upper edge of a beam at 89.9 degrees is the end of the line.
  CHECK(half_power_edges(line, 1.0, std::sin(89.9 * kDeg)).upper_sine == 1.0);
}

TEST_CASE("equivalent widths are lambda / L") {
  const LineArray line = uniform(200, 0.5);
  // At half a wavelength -1..1 is one whole period of the pattern, so sum w^2 / (sum w)^2 lambda / spacing is exact.
  CHECK(equivalent_width(line, 1.0) == Approx(1.0 / 100.0).epsilon(1e-5));
  CHECK(equivalent_width(line, 1.0, 0.8) == Approx(1.0 / 100.0).epsilon(1e-5));
  for (const Window window : {Window::kHann, Window::kHamming, Window::kDolphChebyshev, Window::kTaylor}) {
    const LineArray shaded{.spacing_m = 0.5, .weights = shading_weights({.window = window}, 200)};
    const double exact = 2.0 * std::pow(10.0, -0.1 * white_noise_gain_db(shaded.weights));
    CHECK(equivalent_width(shaded, 1.0) == Approx(exact).epsilon(1e-5));
  }
}

TEST_CASE("the first null of a line is where its window puts it") {
  const auto line = [](const Shading& shading) {
    return LineArray{.spacing_m = 0.5, .weights = shading_weights(shading, 200), .element_length_m = 0.5};
  };
  // Of a length of 100 wavelengths: 1 of a uniform line; 2 of Hann's (of N + 1 elements, half a percent less); of
  // Taylor's sigma sqrt(A^2 + 1/4) [Taylor1955], here 1.0693 sqrt(1.3200^2 + 1/4). Sampled at 200 elements.
  CHECK(first_null(line({}), 1.0) == Approx(0.01).epsilon(1e-9));
  CHECK(first_null(line({.window = Window::kHann}), 1.0) == Approx(0.02 * 200 / 201).epsilon(1e-3));
  CHECK(first_null(line({.window = Window::kTaylor}), 1.0) == Approx(0.015094).epsilon(1e-3));
  // At twice the frequency at half the sine; a line shorter than a wavelength has none.
  CHECK(first_null(line({.window = Window::kTaylor}), 0.5) == Approx(0.5 * 0.015094).epsilon(1e-3));
  CHECK(first_null({.spacing_m = 0.3, .weights = {1.0, 1.0}, .element_length_m = 0.3}, 1.0) == 1.0);
}

TEST_CASE("a shaded line's effective length is that of a uniform one of equal beam integral") {
  const auto line = [](Window window) {
    return LineArray{.spacing_m = 0.5, .weights = shading_weights({.window = window}, 200), .element_length_m = 0.5};
  };
  // Beyond -1..1 a uniform line has the share 1 / pi^2 L of its beam (sinc^2 is 1 / 2 pi^2 L^2 u^2 in the mean), lines
  // that fall off towards their ends less; Dolph and Chebyshev's has level side lobes, and 2 % of its beam there.
  for (const Window window : {Window::kUniform, Window::kHann, Window::kTaylor}) {
    CHECK(1.0 / effective_length_m(line(window)) == Approx(equivalent_width(line(window), 1.0)).epsilon(2e-3));
  }
  const LineArray level = line(Window::kDolphChebyshev);
  CHECK(1.0 / effective_length_m(level) == Approx(equivalent_width(level, 1.0)).epsilon(2.5e-2));
  CHECK(effective_length_m(line(Window::kUniform)) == Approx(100.0));
}

TEST_CASE("the equivalent width of any spacing is the closed double sum over elements") {
  // Integral of |sum w_n exp(2 pi i d n (u - u0))|^2 over -1..1: 2 sum_nm w_n w_m cos(k u0) sinc(2 d (n - m)).
  for (const double spacing : {0.3, 0.8, 1.7}) {  // the last two have grating lobes
    const LineArray line{.spacing_m = spacing, .weights = shading_weights({.window = Window::kHamming}, 24)};
    const double u0 = 0.4;
    double sum = 0.0, weight = 0.0;
    for (int n = 0; n < 24; ++n) {
      weight += line.weights[static_cast<std::size_t>(n)];
      for (int m = 0; m < 24; ++m) {
        sum += 2.0 * line.weights[static_cast<std::size_t>(n)] * line.weights[static_cast<std::size_t>(m)] *
               std::cos(2.0 * kPi * spacing * (n - m) * u0) * sinc(2.0 * spacing * (n - m));
      }
    }
    CHECK(equivalent_width(line, 1.0, u0) == Approx(sum / (weight * weight)).epsilon(1e-5));
  }
}

TEST_CASE("grating lobes are where physics puts them, as high as the main lobe") {
  const LineArray line = uniform(64, 1.2);
  CHECK(power(line, 1.0, 0.3 - 1.0 / 1.2, 0.3) == Approx(1.0));
  CHECK(power(line, 1.0, 1.0 / 1.2) == Approx(1.0));
  // Elements that fill the spacing put a null on every grating lobe of an unsteered array.
  LineArray filled = line;
  filled.element_length_m = 1.2;
  CHECK(power(filled, 1.0, -1.0 / 1.2) < 1e-25);
}

TEST_CASE("an array of a given width has that width") {
  for (const Window window : {Window::kUniform, Window::kHann, Window::kTaylor}) {
    for (const double width_deg : {0.2, 1.0, 3.0, 40.0, 90.0}) {
      const LineArray line = line_array_of_width(width_deg * kDeg, 0.005, {.window = window});
      INFO("window " << static_cast<int>(window) << ", " << width_deg << " deg, " << line.elements() << " elements");
      CHECK(half_power_width_rad(line, 0.005) == Approx(width_deg * kDeg).epsilon(1e-6));
      CHECK(line.element_length_m == line.spacing_m);
      // Only a handful of elements depends on the number of elements itself, so that the spacing overshoots.
      CHECK(line.spacing_m <= 0.005 * (line.elements() > 10 ? 0.51 : 0.75));
    }
  }
  CHECK_THROWS_WITH(line_array_of_width(0.0, 0.005), "a beam 0.000000 rad wide: allowed above 0 to pi/2");
  CHECK_THROWS_WITH(line_array_of_width(0.02, 0.005, {}, 2.0), "elements 2.000000 waves apart: allowed above 0 to 1");
}

TEST_CASE("the phase between halves is 2 pi baseline (u - u0) / lambda") {
  const double u0 = 0.5;
  for (const Window window : {Window::kUniform, Window::kHamming}) {
    for (const int elements : {64, 65}) {
      const LineArray line{.spacing_m = 0.5, .weights = shading_weights({.window = window}, elements)};
      const SplitAperture split = split_aperture(line);
      const LineArray negative{.spacing_m = 0.5, .weights = split.negative};
      const LineArray positive{.spacing_m = 0.5, .weights = split.positive};
      if (window == Window::kUniform) CHECK(split.baseline_m == Approx(elements == 64 ? 16.0 : 16.5));
      for (const double off :
           {-0.01, -0.001, 0.0, 0.002, 0.01}) {  // the half-power edges are at 0.0138 (uniform) and 0.0204
        const auto product = amplitude(positive, 1.0, u0 + off, u0) * std::conj(amplitude(negative, 1.0, u0 + off, u0));
        const double expected = 2.0 * kPi * split.baseline_m * off;
        // Hamming halves are lopsided: third order, 2871 rad per cube of sine at 0.01, where the phase is 0.65 rad.
        const double margin = window == Window::kUniform ? 1e-9 : 3e3 * std::abs(off * off * off) + 1e-9;
        CHECK_THAT(std::arg(product), WithinAbs(expected, margin));
      }
    }
  }
  CHECK_THROWS_WITH(split_aperture(uniform(8, 0.5), 1.0), "a part of 8.000000 of 8 elements: at least 1, and not all");
}

TEST_CASE("any pattern is at most 1, symmetric in steering, with a beam around its axis") {
  const ensonify::random::Stream draw{11, "arrays"};
  for (std::uint64_t i = 0; i < 200; ++i) {
    const auto between = [&](std::uint64_t k, double low, double high) {
      return low + (high - low) * draw.uniform(i, k);
    };
    const Window windows[] = {Window::kUniform, Window::kHann, Window::kHamming, Window::kDolphChebyshev};
    const Shading shading{.window = windows[i % 4], .side_lobe_db = between(0, 13, 100)};
    const double wavelength_m = between(1, 0.001, 0.05), spacing_m = between(2, 0.05, 2.0) * wavelength_m;
    const LineArray line{.spacing_m = spacing_m,
                         .weights = shading_weights(shading, 1 + static_cast<int>(between(3, 0, 300))),
                         .element_length_m = between(4, 0.0, 1.0) * spacing_m};
    const double u = between(5, -1, 1), u0 = between(6, -1, 1);
    INFO("array " << i << ", " << line.elements() << " elements");
    const double value = power(line, wavelength_m, u, u0);
    CHECK(value >= 0.0);
    CHECK(value <= 1.0 + 1e-9);
    CHECK_THAT(power(line, wavelength_m, -u, -u0), WithinAbs(value, 1e-12));
    const BeamEdges edges = half_power_edges(line, wavelength_m, u0);
    CHECK(edges.lower_sine >= -1.0);
    CHECK(edges.lower_sine < u0);
    CHECK(edges.upper_sine > u0);
    CHECK(edges.upper_sine <= 1.0);
  }
}
