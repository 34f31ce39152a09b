#include "tools/console/plan.h"

#include <catch2/catch.hpp>
#include <vector>

using namespace ensonify;
using console::Plan;

namespace {

constexpr const char* kScenario = R"(
ensonify: scenario/1
site: { latitude_deg: 50, longitude_deg: 3 }
seabed: { kind: layers, size_m: [400, 400], layers: { flat: { plane: { depth_m: 20, slope_deg: 0, downhill_heading_deg: 0 } } } }
vehicles: { boat: {} }
mission: { lawnmower: { centre_m: [10, 20], heading_deg: 0, length_m: 100, spacing_m: 30, count: 2 } }
)";

std::vector<double> lines_of(const Plan& plan) {
  const msg::ConsolePlan message = plan.message();
  return {message.line_enu_m.flat().begin(), message.line_enu_m.flat().end()};
}

}  // namespace

TEST_CASE("the plan has the scenario's runlines where they are run") {
  Plan plan;
  plan.read(kScenario);
  CHECK(lines_of(plan) == std::vector<double>{-5, -30, -5, 70, 25, 70, 25, -30});
}

TEST_CASE("lines that an adaptive survey adds follow, and so do marks") {
  Plan plan;
  plan.read(kScenario);
  msg::NextLine next;
  next.number = 1;  // known already
  plan.take(next);
  next.number = 2;
  next.start_enu_m = {55, -30};
  next.end_enu_m = {55, 70};
  plan.take(next);
  next.done = true;
  next.number = 3;
  plan.take(next);
  CHECK(lines_of(plan).size() == 12);
  msg::Mark mark;
  mark.text = "<wreck>";
  mark.position_enu_m = {3, 4, -5};
  plan.take(mark);
  REQUIRE(plan.message().marks.size() == 1);
  CHECK(plan.message().marks[0].text == "<wreck>");
  CHECK(plan.message().marks[0].position_enu_m == std::array<double, 2>{3, 4});
}

TEST_CASE("a scenario that cannot be read gives no plan") {
  Plan plan;
  plan.read("mission: [");
  CHECK(lines_of(plan).empty());
  plan.read("ensonify: scenario/9\n");
  CHECK(lines_of(plan).empty());
}
