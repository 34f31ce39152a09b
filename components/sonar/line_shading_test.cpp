#include <catch2/catch.hpp>

#include "components/config/read_parameters.h"
#include "components/sonar/line_design.h"

using namespace ensonify;
using Window = array::Shading::Window;

namespace {

struct Read {
  array::Shading shading{Window::kTaylor, 30.0, 4};
  std::string problems;
};

Read read(const std::string& yaml) {
  auto from = ConfigReader::from_text(yaml, "head.yaml");
  Read result;
  if (auto section = from.optional_section("shading")) read_parameters(*section, result.shading);
  try {
    from.finish();
  } catch (const ConfigError& error) {
    result.problems = error.what();
  }
  return result;
}

}  // namespace

TEST_CASE("a line's shading is read by the names of its windows, and what is left out stays") {
  CHECK((read("{}").shading == array::Shading{Window::kTaylor, 30.0, 4}));
  CHECK((read("shading: {window: uniform}").shading == array::Shading{Window::kUniform, 30.0, 4}));
  CHECK((read("shading: {window: hann}").shading == array::Shading{Window::kHann, 30.0, 4}));
  CHECK((read("shading: {window: hamming}").shading == array::Shading{Window::kHamming, 30.0, 4}));
  CHECK((read("shading: {window: dolph_chebyshev, side_lobe_db: 25}").shading ==
         array::Shading{Window::kDolphChebyshev, 25.0, 4}));
  CHECK((read("shading: {side_lobe_db: 35, nbar: 5}").shading == array::Shading{Window::kTaylor, 35.0, 5}));
}

TEST_CASE("a shading that no line can have is refused with what is allowed") {
  CHECK(read("shading: {window: kaiser}").problems ==
        "head.yaml:1:19: shading.window: is \"kaiser\", not one of uniform, hann, hamming, dolph_chebyshev, taylor");
  CHECK(read("shading: {side_lobe_db: 10}").problems ==
        "head.yaml:1:25: shading.side_lobe_db: 10 is outside [13, 100]");
  CHECK(read("shading: {nbar: 4, side_lobe_db: 40}").problems ==
        "head.yaml:1:17: shading.nbar: 4 does not hold side lobes at side_lobe_db: 6 to 100 do");
  CHECK(read("shading: {side_lobe_db: 40}").problems ==
        "head.yaml:1:10: shading.nbar: 4 does not hold side lobes at side_lobe_db: 6 to 100 do");
  CHECK(read("shading: {window: dolph_chebyshev, side_lobe_db: 40}").problems.empty());
}
