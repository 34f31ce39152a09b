#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <string>

#include "scenarios/world/world.h"

using namespace ensonify;

TEST_CASE("no room for a survey is reported with the line that requests one") {
  const std::string file =
      std::filesystem::temp_directory_path() / ("ensonify_auto_plan_" + std::to_string(::getpid()) + ".yaml");
  MissionPlan plan;
  plan.scenario_file = file;
  plan.mission.auto_plan = AutoPlan{};
  msg::Chart land;
  land.spacing_m = 8.0;
  land.height_m = msg::Array<float>({101, 101});
  for (float& height : land.height_m.flat()) height = 5.0F;
  const auto reported = [&] {
    try {
      planned_lines(plan, land);
      return std::string("room");
    } catch (const ConfigError& error) {
      return std::string(error.what());
    }
  };
  CHECK_THAT(reported(), Catch::StartsWith(file + ": mission.auto: no room for a survey: "));
  std::ofstream(file) << "seed: 1\nmission: {speed_mps: 2, auto: {count: 3}}\n";
  CHECK_THAT(reported(), Catch::StartsWith(file + ":2:31: mission.auto: no room for a survey: "));
  std::ofstream(file) << "mission: {file: line.yaml}\n";
  CHECK_THAT(reported(), Catch::StartsWith(file + ": mission.auto: no room for a survey: "));
  std::filesystem::remove(file);
}
