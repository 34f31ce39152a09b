#include "kernels/acoustics/array/shading.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "kernels/acoustics/array/line.h"

using namespace ensonify::array;
using Catch::WithinAbs;
using Window = Shading::Window;

namespace {

constexpr double kDeg = std::numbers::pi / 180.0;

/// 128 elements half a wavelength apart: 64 wavelengths long. The wavelength is 1 m.
LineArray line_of(const Shading& shading, int elements = 128) {
  return {.spacing_m = 0.5, .weights = shading_weights(shading, elements)};
}

/// The highest maximum beyond the first minimum, dB.
double highest_side_lobe_db(const LineArray& line) {
  const double step = 1.0 / (100.0 * line.length_m());
  double u = 0.0;
  while (power(line, 1.0, u + step) < power(line, 1.0, u)) u += step;
  double highest = 0.0;
  for (; u < 1.0; u += step) highest = std::max(highest, power(line, 1.0, u));
  return 10.0 * std::log10(highest);
}

}  // namespace

TEST_CASE("widths and side lobes of 128 shaded elements") {
  // Widths in degrees times lambda / L and side lobes in dB: standard values, to the digits that they are printed with.
  struct Row {
    Shading shading;
    double width, width_margin, side_lobe_db, side_lobe_margin;
  };
  const Row rows[] = {
      {{.window = Window::kUniform}, 50.76, 0.01, -13.26, 0.01},
      {{.window = Window::kHann}, 81.9, 0.05, -31.5, 0.05},
      {{.window = Window::kHamming}, 75.0, 0.05, -42.6, 0.05},
      {{.window = Window::kDolphChebyshev, .side_lobe_db = 30.0}, 61.0, 0.05, -30.0, 0.001},
      {{.window = Window::kTaylor, .side_lobe_db = 30.0, .nbar = 4}, 64.4, 0.05, -30.3, 0.05},
  };
  for (const Row& row : rows) {
    const LineArray line = line_of(row.shading);
    const double half = half_power_edges(line, 1.0).upper_sine;
    INFO("window " << static_cast<int>(row.shading.window));
    CHECK_THAT(2.0 * half / kDeg * line.length_m(), WithinAbs(row.width, row.width_margin));
    CHECK_THAT(highest_side_lobe_db(line), WithinAbs(row.side_lobe_db, row.side_lobe_margin));
  }
}

TEST_CASE("Dolph-Chebyshev weights of three elements are those of T2") {
  // T2(x0 cos(psi/2)) = (x0^2 - 1) + x0^2 cos(psi), so the end elements weigh x0^2 / 2 against x0^2 - 1.
  const double x0_squared = 0.5 * (std::pow(10.0, 40.0 / 20.0) + 1.0);  // T2(x0) = 2 x0^2 - 1 = 100
  const auto w = shading_weights({.window = Window::kDolphChebyshev, .side_lobe_db = 40.0}, 3);
  CHECK(w[1] == 1.0);
  CHECK(w[0] == Approx(0.5 * x0_squared / (x0_squared - 1.0)).epsilon(1e-12));
  CHECK(w[2] == Approx(w[0]).epsilon(1e-12));
}

TEST_CASE("every Dolph-Chebyshev side lobe has the set level, for any number of elements") {
  for (const int elements : {5, 10, 33, 128, 501}) {
    for (const double level : {20.0, 40.0, 80.0}) {
      const LineArray line = line_of({.window = Window::kDolphChebyshev, .side_lobe_db = level}, elements);
      INFO(elements << " elements, " << level << " dB");
      CHECK_THAT(highest_side_lobe_db(line), WithinAbs(-level, 0.02));  // peaks are found on a grid of 1/100 lobe
    }
  }
}

TEST_CASE("Taylor side lobes are at the level asked for or up to 0.7 dB below") {
  for (const double level : {20.0, 30.0, 40.0, 60.0, 80.0}) {
    const double A = std::acosh(std::pow(10.0, level / 20.0)) / std::numbers::pi;
    for (const int more : {0, 3}) {
      const int nbar = static_cast<int>(std::lround(2.0 * A * A + 0.5)) + more;
      const LineArray line = line_of({.window = Window::kTaylor, .side_lobe_db = level, .nbar = nbar}, 256);
      INFO(level << " dB, nbar " << nbar);
      const double highest = highest_side_lobe_db(line);
      CHECK(highest <= -level + 0.02);  // samples of a continuous line
      CHECK(highest >= -level - 0.7);
    }
  }
}

TEST_CASE("weights agree with SciPy's") {
  // SciPy 1.10: chebwin(7, 40); taylor(9, nbar=4, sll=30, norm=False) and taylor(8, 5, 35), over their largest value.
  const double chebyshev[] = {0.15941069, 0.47936432, 0.83973877, 1.0, 0.83973877, 0.47936432, 0.15941069};
  const auto c = shading_weights({.window = Window::kDolphChebyshev, .side_lobe_db = 40.0}, 7);
  for (std::size_t n = 0; n < 7; ++n) CHECK_THAT(c[n], WithinAbs(chebyshev[n], 1e-8));
  const double taylor_odd[] = {0.27188349, 0.46690632, 0.72467511, 0.92465583, 1.0};
  const auto odd = shading_weights({.window = Window::kTaylor, .side_lobe_db = 30.0, .nbar = 4}, 9);
  for (std::size_t n = 0; n < 5; ++n) CHECK_THAT(odd[n], WithinAbs(taylor_odd[n], 1e-8));
  const double taylor_even[] = {0.2094859, 0.47330721, 0.78930108, 1.0};
  const auto even = shading_weights({.window = Window::kTaylor, .side_lobe_db = 35.0, .nbar = 5}, 8);
  for (std::size_t n = 0; n < 4; ++n) CHECK_THAT(even[n], WithinAbs(taylor_even[n], 1e-8));
}

TEST_CASE("uniform weights have the most gain; windows are symmetric with largest weight 1") {
  for (const int elements : {1, 2, 3, 16, 77}) {
    for (const Window window :
         {Window::kUniform, Window::kHann, Window::kHamming, Window::kDolphChebyshev, Window::kTaylor}) {
      const auto w = shading_weights({.window = window}, elements);
      INFO("window " << static_cast<int>(window) << ", " << elements << " elements");
      REQUIRE(w.size() == static_cast<std::size_t>(elements));
      CHECK(*std::max_element(w.begin(), w.end()) == 1.0);
      for (std::size_t n = 0; n < w.size(); ++n) CHECK_THAT(w[n], WithinAbs(w[w.size() - 1 - n], 1e-12));
      const double gain = white_noise_gain_db(w);
      if (window == Window::kUniform) CHECK(gain == Approx(10.0 * std::log10(elements)));
      if (window != Window::kUniform && elements > 3) CHECK(gain < 10.0 * std::log10(elements));
    }
  }
}

TEST_CASE("Hann and Hamming lose 1.73 and 1.37 dB against independent noise") {
  // Equivalent noise bandwidths 1.50 and 1.36 of [Harris1978] are limits for many elements: -1.761 and -1.344 dB.
  for (const int elements : {128, 4096}) {
    const double uniform = 10.0 * std::log10(elements);
    const double margin = 10.0 / std::log(10.0) * 3.0 / elements;  // ends: an element or so more or less
    CHECK_THAT(white_noise_gain_db(shading_weights({.window = Window::kHann}, elements)) - uniform,
               WithinAbs(-10.0 * std::log10(1.5), margin));
    CHECK_THAT(white_noise_gain_db(shading_weights({.window = Window::kHamming}, elements)) - uniform,
               WithinAbs(-10.0 * std::log10(1.3628), margin));
  }
}

TEST_CASE("a shading that cannot be is refused with what is allowed") {
  CHECK_THROWS_WITH(shading_weights({}, 0), "an array of 0 elements: at least 1");
  CHECK_THROWS_WITH(shading_weights({.window = Window::kDolphChebyshev, .side_lobe_db = 5.0}, 16),
                    "side lobes 5.000000 dB below the main lobe: allowed 13 to 100");
  CHECK_THROWS_WITH(shading_weights({.window = Window::kTaylor, .side_lobe_db = 40.0, .nbar = 4}, 16),
                    "nbar 4 of a Taylor shading with side lobes at 40.000000 dB: allowed 6 to 100");
  CHECK_THROWS_AS(shading_weights({.window = Window::kTaylor, .side_lobe_db = std::nan("")}, 16),
                  std::invalid_argument);
}
