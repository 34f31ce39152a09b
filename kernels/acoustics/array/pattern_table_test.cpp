#include <catch2/catch.hpp>
#include <cmath>

#include "kernels/acoustics/array/aperture.h"
#include "kernels/acoustics/array/line.h"

using namespace ensonify::array;
using Window = Shading::Window;

namespace {

double largest_error(const PatternTable& table, const std::function<std::complex<double>(double)>& exact) {
  double largest = 0.0;
  for (double u = -1.0; u <= 1.0; u += 0.000113) {
    largest = std::max(largest, std::abs(std::complex<double>(table.amplitude(u)) - exact(u)));
  }
  return largest;
}

}  // namespace

TEST_CASE("a table is as near to the sum as it promises, and not much nearer") {
  for (const double error : {1e-3, 1e-4, 1e-5}) {
    for (const Window window : {Window::kUniform, Window::kTaylor}) {
      const LineArray line{
          .spacing_m = 0.5, .weights = shading_weights({.window = window}, 200), .element_length_m = 0.5};
      const PatternTable table(line, 1.0, 0.4, error);
      const double worst = largest_error(table, [&](double u) { return amplitude(line, 1.0, u, 0.4); });
      INFO("error " << error << ", window " << static_cast<int>(window));
      CHECK(worst < error + 1e-6);
      // The bound is for two end elements alone; these fill the whole line: a fifth of it for uniform, a tenth for
      // Taylor.
      CHECK(worst > error / 15.0);
    }
  }
}

TEST_CASE("a table for -80 dB has 12 points per lambda / L") {
  const LineArray line{.spacing_m = 0.5, .weights = shading_weights({}, 200)};
  CHECK(PatternTable(line, 1.0).size() == Approx(2.0 * 100.0 * 12.3).epsilon(0.02));
}

TEST_CASE("the ends, sines beyond them, single elements and pistons are defined") {
  const LineArray line{.spacing_m = 0.5, .weights = shading_weights({}, 32)};
  const PatternTable table(line, 1.0, 0.2);
  CHECK(std::abs(std::complex<double>(table.amplitude(1.0)) - amplitude(line, 1.0, 1.0, 0.2)) < 1e-4);
  CHECK(table.amplitude(1.0000001) == table.amplitude(1.0));
  CHECK(table.amplitude(-3.0) == table.amplitude(-1.0));
  CHECK(PatternTable({.spacing_m = 0.5, .weights = {1.0}}, 1.0).amplitude(0.3).real() == Approx(1.0F));

  const PatternTable piston([](double s) { return piston_amplitude(25.0, s); }, 12.5);
  CHECK(largest_error(piston, [](double s) { return piston_amplitude(25.0, s); }) < 1e-4);
  CHECK_THROWS_WITH(PatternTable(line, 1.0, 0.0, 0.5),
                    "a pattern table with an error of 0.500000: allowed 1e-6 to 0.1");
}
