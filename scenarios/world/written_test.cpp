#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "components/config/config_reader.h"
#include "components/config/parse_yaml.h"
#include "components/config/scalar_text.h"
#include "scenarios/world/world.h"

namespace ensonify {
namespace {

namespace fs = std::filesystem;

/// Every shipped scenario.
std::vector<std::string> shipped() {
  std::vector<std::string> files;
  for (const char* top : {"scenarios", "bench", "docs", "examples"}) {
    for (const auto& entry :
         fs::recursive_directory_iterator(std::string(std::getenv("ENSONIFY_SOURCE")) + "/" + top)) {
      if (entry.path().extension() != ".yaml") continue;
      const ConfigDocument document = parse_config_file(entry.path());
      const ConfigNode* format = document.root.find("ensonify");
      if (format != nullptr && format->scalar == kScenarioFormat) files.push_back(entry.path());
    }
  }
  return files;
}

std::string written(ConfigDocument document) {
  std::string text;
  ConfigReader from(std::move(document));
  read_world(from, "world.yaml", &text);
  from.finish();
  return text;
}
std::string written(const std::string& text) { return written(load_scenario(parse_config(text, "written.yaml"))); }

bool equal_values(const ConfigNode& a, const ConfigNode& b) {
  const auto x = parse_number(a.scalar), y = parse_number(b.scalar);
  if (x && y) return *x == *y;
  return a.scalar == b.scalar || b.scalar.ends_with("/" + a.scalar.substr(a.scalar.find_last_of('/') + 1));
}

/// Values of a file that what is written of it lacks or has otherwise.
void compare(const ConfigNode& given, const ConfigNode& written, const std::string& path, std::string& lost) {
  if (given.is_scalar() && written.is_map()) {  // short for a map with one key
    bool found = false;
    for (const auto& entry : written.entries) found = found || equal_values(given, entry.value);
    if (!found) lost += path + " ";
    return;
  }
  if (given.kind != written.kind || given.items.size() != written.items.size() ||
      (given.is_scalar() && !equal_values(given, written))) {
    lost += path + " ";
    return;
  }
  for (const auto& entry : given.entries) {
    const ConfigNode* found = written.find(entry.key);
    if (found == nullptr) lost += path + "." + entry.key + " ";
    else compare(entry.value, *found, path + "." + entry.key, lost);
  }
  for (std::size_t i = 0; i < given.items.size(); ++i) {
    compare(given.items[i], written.items[i], path + "[" + std::to_string(i) + "]", lost);
  }
}

}  // namespace

TEST_CASE("what is written of each shipped scenario has all its values, and reads as the same") {
  REQUIRE(shipped().size() > 20);
  for (const std::string& file : shipped()) {
    INFO(file);
    ConfigDocument document = load_scenario(file);
    ConfigNode* seabed = document.root.find("seabed");
    if (ConfigNode* raster = seabed->find("raster"); raster && raster->find("path")->scalar.empty()) {
      raster->set("path", ConfigNode::text(file));  // a launch says which; here it must only be there
    }
    const std::string once = written(document);
    INFO(once);
    CHECK(written(once) == once);
    std::string lost;
    compare(document.root, parse_config(once, "written.yaml").root, "", lost);
    CHECK(lost == "");
  }
}

TEST_CASE("a value that is lost in writing is found") {
  const std::string given = "mission: {run_in_m: 3, steps: [{line: [[0, 0], [1, 1]]}]}\nseabed: {sediments: {0: clay}}";
  const auto lost_of = [&](const std::string& text) {
    std::string lost;
    compare(parse_config(given, "a.yaml").root, parse_config(text, "b.yaml").root, "", lost);
    return lost;
  };
  CHECK(lost_of(given) == "");
  CHECK(
      lost_of("mission: {run_in_m: 3.0, steps: [{line: [[0, 0], [1, 1]]}]}\nseabed: {sediments: {0: {name: clay}}}") ==
      "");
  CHECK(lost_of("mission: {steps: [{line: [[0, 0], [1, 2]]}]}\nseabed: {sediments: {0: {name: sand}}}") ==
        ".mission.run_in_m .mission.steps[0].line[1][1] .seabed.sediments.0 ");
}

TEST_CASE("a speed in knots, a mission of its own and places in degrees are written as they are in force") {
  const fs::path mission = fs::temp_directory_path() / "ensonify_written_mission.yaml";
  std::ofstream(mission) << "ensonify: mission/1\npositions: geodetic\nspeed_kn: 3\nrepeat: 2\n"
                            "steps: [{line: [[42.5, -70.5], [42.501, -70.5]]}, {wait_s: 3}, {speed_mps: 1}]\n";
  const std::string text =
      "ensonify: scenario/1\nsite: {latitude_deg: 42.5, longitude_deg: -70.5}\nseabed: {kind: layers}\n"
      "mission: {repeat: 3, file: " +
      mission.string() + "}\n";
  const std::string once = written(text);
  fs::remove(mission);
  INFO(once);
  CHECK(written(once) == once);
  CHECK(once.find("positions: geodetic") != std::string::npos);
  CHECK(once.find("speed_mps: 1.5433333333333") != std::string::npos);
  CHECK(once.find("repeat: 3") != std::string::npos);
  CHECK(once.find("line: [[42.5, -70.5], [42.501, -70.5]]") != std::string::npos);
  CHECK(once.find("speed_kn") == std::string::npos);
  CHECK(once.find("file:") == std::string::npos);
}

TEST_CASE("settings of a head in a mission of its own are written, and no others") {
  const fs::path mission = fs::temp_directory_path() / "ensonify_written_settings.yaml";
  std::ofstream(mission) << "ensonify: mission/1\nsteps: [{line: [[0, 0], [0, 90]]}, {set_sonar: bow, range_m: 40, "
                            "swath_deg: 90}]\n";
  const std::string text =
      "ensonify: scenario/1\nsite: {latitude_deg: 42.5, longitude_deg: -70.5}\nseabed: {kind: layers}\n"
      "vehicles: {boat: {mountings: {bow: {actual: {}}}}}\nmission: {file: " +
      mission.string() + "}\n";
  const std::string once = written(text);
  fs::remove(mission);
  INFO(once);
  CHECK(written(once) == once);
  CHECK(once.find("range_m: 40") != std::string::npos);
  CHECK(once.find("swath_deg: 90") != std::string::npos);
  CHECK(once.find("source_level_db") == std::string::npos);
}

}  // namespace ensonify
