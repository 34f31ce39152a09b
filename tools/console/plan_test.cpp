#include "tools/console/plan.h"

#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "components/config/config_reader.h"
#include "components/config/parse_yaml.h"
#include "scenarios/world/world.h"

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

TEST_CASE("lines that are laid over a chart are those of the autopilot, whichever of scenario and chart comes first") {
  const std::string scenario = std::string(kScenario).replace(
      std::string(kScenario).find("mission:"), std::string::npos, "mission: { speed_mps: 2, auto: { count: 3 } }\n");
  msg::Chart chart;
  chart.west_m = chart.south_m = -300;
  chart.east_m = chart.north_m = 300;
  chart.spacing_m = 10;
  chart.height_m = msg::Array<float>({61, 61});
  for (float& height_m : chart.height_m.flat()) height_m = -20;

  Plan plan;
  plan.read(scenario);
  CHECK(lines_of(plan).empty());
  plan.take(chart);
  ConfigReader from(parse_config(scenario, "scenario.yaml"));
  const World world = read_world(from, "scenario.yaml");
  const auto wanted = planned_lines(MissionPlan::of(world, world.vehicles.front()), chart);
  REQUIRE(wanted.size() == 3);
  const std::vector<double> lines = lines_of(plan);
  REQUIRE(lines.size() == 12);
  CHECK(lines[8] == wanted[2].start_enu_m.x());
  CHECK(lines[11] == wanted[2].end_enu_m.y());

  Plan other;
  other.take(chart);
  other.read(scenario);
  CHECK(lines_of(other) == lines);
}

TEST_CASE("a scenario that cannot be read gives no plan") {
  Plan plan;
  plan.read("mission: [");
  CHECK(lines_of(plan).empty());
  plan.read("ensonify: scenario/9\n");
  CHECK(lines_of(plan).empty());
}
