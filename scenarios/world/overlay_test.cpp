#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "components/config/config_error.h"
#include "components/config/parse_yaml.h"
#include "scenarios/world/world.h"

namespace ensonify {

namespace {

namespace fs = std::filesystem;

constexpr const char* kUnder = R"(ensonify: scenario/1
site: {latitude_deg: 50, longitude_deg: -4}
water: {temperature_degc: 12, sound_speed_mps: 1490, applied: {sound_speed_mps: 1480}}
vertical: {tide: {mean_m: 1, constituents: [{constituent: M2, amplitude_m: 1}]}}
seabed: {kind: layers, size_m: [400, 400], sediments: {0: clay}, layers: {slope: {plane: {depth_m: 20}}}}
vehicles: {boat: {}}
mission: {speed_mps: 2, runlines: [{from_m: [0, -100], to_m: [0, 100]}]}
)";

/// Files of a test, gone at its end.
struct Files {
  fs::path folder = fs::temp_directory_path() / ("ens-overlay-" + std::to_string(::getpid()));
  Files() {
    fs::create_directories(folder / "below");
    write("below/under.yaml", kUnder);
    write("below/cast.csv", "depth_m,sound_speed_mps\n0,1500\n30,1490\n");
  }
  ~Files() { fs::remove_all(folder); }
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(folder / name) << text;
    return (folder / name).string();
  }
  std::string path(const std::string& name) const { return (folder / name).string(); }
  /// Problems of a scenario, without the folder.
  std::string problems(const std::string& name, const Overrides& overrides = {}) const {
    try {
      read_world(path(name), overrides);
    } catch (const ConfigError& error) {
      std::string text = error.what();
      for (std::size_t at = 0; (at = text.find(folder.string() + "/")) != std::string::npos;)
        text.erase(at, folder.string().size() + 1);
      return text;
    }
    return "";
  }
};

Overrides set(const std::string& key, const std::string& value) {
  ConfigNode node = parse_config_value(value, {"--set " + key});
  return {{key, node}};
}

}  // namespace

TEST_CASE("a scenario stands over another: its keys replace, what it leaves out stays") {
  const Files files;
  files.write("over.yaml",
              "ensonify: scenario/1\ninclude: below/under.yaml\nseed: 7\nwater: {cast: below/cast.csv}\n"
              "vertical: {tide: {constant_m: 2}}\nseabed: {sediments: {0: rock}}\n");
  const World world = read_world(files.path("over.yaml"));
  CHECK(world.seed == 7);
  CHECK(world.water.temperature_degc == 12.0);
  CHECK(world.water.profile.samples.size() == 2);
  CHECK_FALSE(world.water.profile.sound_speed_mps.has_value());
  CHECK(world.vertical.tide.at(0.0).height_m == 2.0);
  CHECK(world.seabed.layered.layers.size() == 1);
  CHECK(world.vehicles.size() == 1);
}

TEST_CASE("a cast, a tide and a sediment are set over a scenario that has others") {
  const Files files;
  const std::string under = files.path("below/under.yaml");
  const World cast = read_world(under, set("water.cast", files.path("below/cast.csv")));
  CHECK(cast.water.profile.samples.size() == 2);
  CHECK_FALSE(cast.water.profile.sound_speed_mps.has_value());
  CHECK(cast.water.applied.sound_speed_mps == 1480.0);  // of its own
  CHECK(read_world(under, set("water.applied.cast", files.path("below/cast.csv"))).water.applied.samples.size() == 2);
  CHECK(read_world(under, set("vertical.tide.constant_m", "1.5")).vertical.tide.at(0.0).height_m == 1.5);
  CHECK(read_world(under, set("vertical.tide.mean_m", "3")).vertical.tide.at(0.0).height_m > 3.0);  // keeps its waves
  const auto rock = read_world(under, set("seabed.sediments.0", "rock")).seabed.sediments.at(0);
  CHECK(std::get<seabed::SedimentParameters>(rock) == *seabed::sediment_of("rock"));
}

TEST_CASE("a plan of a mission replaces the plan that it stands over, whatever their kinds") {
  const Files files;
  files.write("over.yaml",
              "ensonify: scenario/1\ninclude: below/under.yaml\n"
              "mission: {steps: [{line: [[0, 0], [0, 50]]}]}\n");
  CHECK(files.problems("over.yaml") == "");
  files.write("below/plan.yaml", "ensonify: mission/1\nrunlines: [{from_m: [0, -50], to_m: [0, 50]}]\n");
  files.write("over.yaml", "ensonify: scenario/1\ninclude: below/under.yaml\nmission: {file: below/plan.yaml}\n");
  CHECK(read_world(files.path("over.yaml")).mission.runlines.at(0).start_enu_m.y() == -50.0);
}

TEST_CASE("the keys of a cast may be set one by one over a scenario with another water") {
  const Files files;
  files.write("bare.csv", "0,1500\n30,1490\n");
  Overrides cast = set("water.cast.path", files.path("bare.csv"));
  cast.push_back(set("water.cast.depth_m", "1").front());
  cast.push_back(set("water.cast.sound_speed_mps", "2").front());
  const World world = read_world(files.path("below/under.yaml"), cast);
  CHECK(world.water.profile.samples.size() == 2);
  CHECK_FALSE(world.water.profile.sound_speed_mps.has_value());
}

TEST_CASE("mistakes have the place in the file that made them") {
  const Files files;
  files.write("over.yaml", "ensonify: scenario/1\ninclude: below/under.yaml\nwater: {salinity_psu: salty}\n");
  CHECK(files.problems("over.yaml") == "over.yaml:3:23: water.salinity_psu: is \"salty\", not a number in [0, 45]");
  files.write("below/under.yaml", std::string(kUnder) + "sea: {}\n");
  files.write("over.yaml", "ensonify: scenario/1\ninclude: below/under.yaml\n");
  CHECK(files.problems("over.yaml").starts_with("below/under.yaml:8:1: sea: is not a known key"));
  files.write("over.yaml", "ensonify: scenario/1\ninclude: below/none.yaml\n");
  CHECK(files.problems("over.yaml").starts_with("over.yaml:2:10: include: \"below/none.yaml\": no such file"));
  files.write("over.yaml", "ensonify: scenario/1\ninclude: [a, b]\n");
  CHECK(files.problems("over.yaml").starts_with("over.yaml:2:10: include: is not the file of a scenario"));
  files.write("over.yaml", "ensonify: scenario/1\ninclude:\n");
  CHECK(files.problems("over.yaml").find("include: is not the file of a scenario") != std::string::npos);
  files.write("over.yaml", "include: below/under.yaml\n");
  CHECK(files.problems("over.yaml").find("does not say \"ensonify: scenario/1\"") != std::string::npos);
  files.write("over.yaml", "ensonify: scenario/1\ninclude: below/cast.yaml\n");
  files.write("below/cast.yaml", "ensonify: launch/1\n");
  CHECK(files.problems("over.yaml").starts_with("over.yaml:2:10: include: \"below/cast.yaml\" is no scenario/1"));
  files.write("below/cast.yaml", "ensonify: scenario/1\ninclude: ../over.yaml\n");
  CHECK(files.problems("over.yaml").find("include: \"../over.yaml\" includes itself, directly or through others") !=
        std::string::npos);
  files.write("below/under.yaml", kUnder);
  CHECK(files.problems("below/under.yaml", set("water.cast", "below/none.csv")).starts_with("--set water.cast: "));
}

}  // namespace ensonify
