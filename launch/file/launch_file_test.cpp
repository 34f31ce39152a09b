#include "launch/file/launch_file.h"

#include <CLI/CLI.hpp>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "components/config/config_text.h"
#include "launch/file/tree.h"
#include "scenarios/world/world.h"

namespace ensonify {
namespace {

namespace fs = std::filesystem;

const char* const kWorld = R"(ensonify: scenario/1
site: {latitude_deg: 42.5, longitude_deg: -70.5}
seabed: {kind: layers}
mission: {runlines: [{from_m: [0, 0], to_m: [100, 0]}]}
)";

const char* const kLaunch = R"(ensonify: launch/1
args: {raster: "", gain: 3}
scenario: world.yaml
processes:
  auv:   { run: vehicle, cpus: [0, 1], env: {A: b} }
  bow:   { run: multibeam, config: head.yaml }
  pager: { run: terrain_pager, config: { raster: $(raster), gain_db: $(gain) } }
  agent: { run: [python3, agent.py, --to, $(out)/agent.csv] }
wiring:
  auv.command: { topic: agent/command, delay_ms: 100 }
  bow.pose: auv/pose
after: [[ensonify, plot, $(out)]]
duration_s: 12.5
)";

/// A folder of files that lives as long as the test.
class Folder {
 public:
  Folder() : path_(fs::temp_directory_path() / ("launch_test_" + std::to_string(::getpid()))) {
    fs::remove_all(path_);
    fs::create_directories(path_);
    add("world.yaml", kWorld);
    add("head.yaml", "frequency_hz: 300e3\n");
    add("x.yaml", kLaunch);
  }
  ~Folder() { fs::remove_all(path_); }

  void add(const std::string& name, const std::string& text) const {
    fs::create_directories((path_ / name).parent_path());
    std::ofstream(path_ / name) << text;
  }
  std::string file(const std::string& name) const { return (path_ / name).string(); }

  Launch read(LaunchOptions options = {}) const {
    options.file = file(options.file.empty() ? "x.yaml" : options.file);
    return read_launch(options, [](ConfigReader& from, const std::string& scenario) { read_world(from, scenario); });
  }
  /// What is wrong, with the folder's own name left out.
  std::string problems(LaunchOptions options = {}) const {
    try {
      read(std::move(options));
      return "";
    } catch (const ConfigError& error) {
      std::string text = error.what();
      for (auto at = text.find(path_.string() + "/"); at != std::string::npos; at = text.find(path_.string() + "/")) {
        text.erase(at, path_.string().size() + 1);
      }
      return text;
    }
  }

 private:
  fs::path path_;
};

std::string replaced(std::string text, const std::string& old_part, const std::string& new_part) {
  const auto at = text.find(old_part);
  REQUIRE(at != std::string::npos);
  return text.replace(at, old_part.size(), new_part);
}

}  // namespace

TEST_CASE("every section of a scenario can be set over it") {
  for (const ParameterInfo& info : scenario_list())
    CHECK(is_scenario_section(info.key) == (info.key != "ensonify" && info.key != "include"));
  const Folder folder;
  CHECK(folder.problems({.sets = {"vertical.tide.constant_m=1.2",
                                  "current.profile=[{depth_m: 0, speed_mps: 0.1, "
                                  "heading_deg: 90}]"}}) == "");
  CHECK(folder.problems({.sets = {"vertical.tide.constant_m=high"}}) ==
        "--set vertical.tide.constant_m: is \"high\", not a number in [-20, 20]");
}

TEST_CASE("a launch file is read with its processes in order, its wiring and its world") {
  const Folder folder;
  const Launch launch = folder.read({.args = {"gain=5"}, .out = "results"});
  REQUIRE(launch.processes.size() == 4);
  CHECK(launch.processes[0].name == "auv");
  CHECK(launch.processes[0].component == "vehicle");
  CHECK(launch.processes[0].cpus == std::vector<int>{0, 1});
  CHECK(launch.processes[0].env.at("A") == "b");
  CHECK(to_json(launch.processes[2].config.root) == R"({"raster":"","gain_db":5})");
  CHECK(launch.process("agent").argv == std::vector<std::string>{"python3", "agent.py", "--to", "results/agent.csv"});
  CHECK(launch.process("agent").component.empty());
  REQUIRE(launch.wiring.size() == 2);
  CHECK(launch.wiring[0].process == "auv");
  CHECK(launch.wiring[0].port == "command");
  CHECK(launch.wiring[0].topic == "agent/command");
  CHECK(launch.wiring[0].delay == SimTime{100'000'000});
  CHECK(launch.wiring[1].topic == "auv/pose");
  CHECK_FALSE(launch.wiring[1].delay.has_value());
  CHECK_FALSE(launch.scenario.path.empty());
  CHECK(World::read(launch.scenario).mission.runlines.size() == 1);
  CHECK(launch.duration == SimTime{12'500'000'000});
  REQUIRE(launch.after.size() == 1);
  CHECK(launch.after[0].words == std::vector<std::string>{"ensonify", "plot", "results"});
  CHECK_FALSE(launch.clock.rate.has_value());
  CHECK_THROWS_AS(launch.process("stern"), std::out_of_range);
}

TEST_CASE("each process reads its own parameters, with the place where they stand") {
  const Folder folder;
  const auto frequency = [&](LaunchOptions options, const std::string& name, const char* key) {
    ConfigReader from = folder.read(std::move(options)).process(name).reader();
    double value = 0;
    from.required(key, value, 100e3, 1e6);
    from.finish();
    return value;
  };
  CHECK(frequency({}, "bow", "frequency_hz") == 300e3);
  CHECK(frequency({.sets = {"bow.frequency_hz=2e5"}}, "bow", "frequency_hz") == 2e5);
  CHECK_THROWS_WITH(frequency({.sets = {"bow.frequency_hz=50000"}}, "bow", "frequency_hz"),
                    "--set bow.frequency_hz: 50000 is outside [100000, 1e+06]");
  CHECK_THROWS_WITH(
      frequency({}, "bow", "speed"),
      Catch::EndsWith("head.yaml:1:1: frequency_hz: is not a known key; known keys: speed\n" +
                      folder.file("head.yaml") + ":1:1: speed: is missing; allowed: a number in [100000, 1e+06]"));
  CHECK_THROWS_WITH(frequency({}, "pager", "gain_db"),
                    Catch::Contains("x.yaml:7:70: processes.pager.config.gain_db: 3 is outside [100000, 1e+06]"));
}

TEST_CASE("--set and set: change processes, scenario and clock; the command line wins") {
  const Folder folder;
  folder.add("x.yaml",
             std::string(kLaunch) + "set: {bow.frequency_hz: 1e5, seed: 4, clock.rate: 2}\nclock: {window_s: 2}\n");
  const Launch launch = folder.read(
      {.sets = {"bow.frequency_hz=2e5", "mission.runlines.0.to_m=[50, 0]", "water.ph=8.1", "clock.slip_policy=fail"}});
  CHECK(to_json(launch.process("bow").config.root) == R"({"frequency_hz":200000})");
  CHECK(launch.scenario.header.seed == 4);
  CHECK(World::read(launch.scenario).water.ph == 8.1);
  CHECK(runlines::length_m(World::read(launch.scenario).mission.runlines[0]) == 50);
  CHECK(launch.clock.rate == 2.0);
  CHECK(launch.clock.window_s == 2.0);
  CHECK(launch.clock.slip_policy == ClockSettings::SlipPolicy::kFail);
  CHECK(
      folder.problems({.sets = {"bwo.frequency_hz=1", "water.phh=7", "clock.rate=fast", "seed", "bow=3", "seed=x"}}) ==
      "--set bow: names no key of bow; allowed: bow.KEY\n"
      "--set bwo.frequency_hz: names no process, scenario section or clock; did you mean bow?\n"
      "--set clock.rate: is \"fast\", not a number in [0.001, 1e+06]\n"
      "--set seed: is not KEY=VALUE\n"
      "--set seed: is \"x\", not a whole number from 0 to 2^64 - 1\n"
      "--set water.phh: is not a known key; did you mean ph?");
}

TEST_CASE("instructions are the machine's widest, or those that the launch or the command line names") {
  const Folder folder;
  folder.add("x.yaml", std::string(kLaunch) + "isa: best\n");
  CHECK_FALSE(folder.read({}).isa);
  CHECK(isa_of(folder.read({})) == widest_isa());
  CHECK(folder.read({.sets = {"isa=avx2"}}).isa == Isa::kAvx2);
  CHECK(isa_of(folder.read({.sets = {"isa=avx2"}})) == Isa::kAvx2);
  CHECK(folder.read({.sets = {"isa=avx2"}}).launch_text != folder.read({}).launch_text);
  const Launch wide = folder.read({.sets = {"isa=avx512"}});
  if (widest_isa() == Isa::kAvx512) CHECK(isa_of(wide) == Isa::kAvx512);
  else CHECK_THROWS_WITH(isa_of(wide), Catch::Contains("isa: this machine has no avx512; allowed: best, avx2"));
  CHECK(folder.problems({.sets = {"isa=sse"}}) == "--set isa: is \"sse\", not one of best, avx2, avx512");
}

TEST_CASE("of the expectations exit codes are the launcher's, the others a process's") {
  const Folder folder;
  folder.add("x.yaml", std::string(kLaunch) +
                           "expect:\n- exit: {process: agent, code: 3}\n- {count: bow/ping}\n"
                           "- {name: shot, exit: {process: bow, signal: SIGKILL}}\n");
  const Launch launch = folder.read();
  REQUIRE(launch.exits.size() == 2);
  CHECK(launch.exits[0].name == "agent ends with exit code 3");
  CHECK((launch.exits[0].code == 3 && launch.exits[0].signal == 0));
  CHECK(launch.exits[1].name == "shot");
  CHECK((launch.exits[1].code == 0 && launch.exits[1].signal == 9));
  CHECK(to_json(launch.processes.back().config.root) == R"({"expect":[{"count":"bow/ping"}]})");

  folder.add("x.yaml", std::string(kLaunch) + "expect: [{exit: {process: agent, code: 0}}]\n");
  CHECK(folder.read().processes.back().name == "agent");  // nothing is left for a process of its own
}

TEST_CASE("--record adds a recorder, expectations add the process that checks them") {
  const Folder folder;
  folder.add("x.yaml", std::string(kLaunch) + "expect: [{count: bow/ping, at_least: 3}]\n");
  const Launch launch = folder.read({.record = "a.mcap"});
  REQUIRE(launch.processes.size() == 6);
  CHECK(launch.processes[4].component == "recorder");
  CHECK(to_json(launch.processes[4].config.root) ==
        R"({"file":")" + (fs::current_path() / "a.mcap").string() + R"(","topics":"all"})");
  CHECK(launch.processes[5].name == "expect");
  CHECK(to_json(launch.processes[5].config.root) == R"({"expect":[{"count":"bow/ping","at_least":3}]})");
}

TEST_CASE("the text of a run does not know where, how fast and into which file it ran") {
  const Folder folder;
  folder.add("x.yaml", replaced(kLaunch, "gain_db:", "file: $(out)/x, gain_db:"));
  const Launch a = folder.read({.args = {"raster=/home/me/bay.tif"}, .record = "a.mcap", .out = "/tmp/a"});
  const Launch b =
      folder.read({.args = {"raster=/root/bay.tif"}, .sets = {"clock.rate=4"}, .record = "b.mcap", .out = "b"});
  CHECK(a.launch_text == b.launch_text);
  CHECK(a.scenario.text == b.scenario.text);
  CHECK(a.launch_text.find("/tmp") == std::string::npos);
  CHECK(a.launch_text.find("raster: bay.tif") != std::string::npos);
  CHECK(a.launch_text.find("$(out)/x") != std::string::npos);
  CHECK(folder.read({.args = {"gain=4"}}).launch_text != a.launch_text);
  CHECK(folder.read({.sets = {"seed=4"}}).scenario.text != a.scenario.text);
}

TEST_CASE("faults to inject are read, each with its own keys") {
  const Folder folder;
  folder.add("x.yaml", std::string(kLaunch) + R"(inject:
  - { mute: bow/ping, from_s: 20, to_s: 40 }
  - { drop: auv, share: 0.3 }
  - { delay: auv/pose, by_ms: 500, from_s: 10 }
  - { corrupt: agent/command, field: heading_grid_rad, value: nan, from_s: 5 }
  - { kill: agent, at_s: 12, signal: TERM }
  - { pause: bow, at_s: 3, for_wall_s: 2 }
)");
  const Launch launch = folder.read();
  REQUIRE(launch.injections.size() == 6);
  CHECK((launch.injections[0].kind == Injection::Kind::kMute));
  CHECK(launch.injections[0].target == "bow/ping");
  CHECK(launch.injections[0].to == 40_s);
  CHECK(launch.injections[1].share == 0.3);
  CHECK(launch.injections[1].to > 1'000'000_s);
  CHECK(launch.injections[2].by == 500_ms);
  CHECK(launch.injections[3].value == "nan");
  CHECK(launch.injections[4].signal == 15);
  CHECK(launch.injections[4].from == 12_s);
  CHECK(launch.injections[5].wall_s == 2.0);
  CHECK(launch.launch_text.find("inject") != std::string::npos);
  CHECK_THAT(launch.injections[0].place, Catch::EndsWith("x.yaml:15:5: inject[0]"));
}

TEST_CASE("faults that cannot be injected are refused with their place") {
  const Folder folder;
  const auto of = [&](const std::string& entry) {
    folder.add("x.yaml", std::string(kLaunch) + "inject: [" + entry + "]\n");
    return folder.problems();
  };
  CHECK(of("{mute: bow/ping, from_s: 3, to_s: 3}") == "x.yaml:14:10: inject[0]: to_s is not after from_s");
  CHECK(of("{kill: bo, at_s: 3}") == "x.yaml:14:10: inject[0]: no process is named bo; did you mean bow?");
  CHECK(of("{kill: bow/ping, at_s: 3}") == "x.yaml:14:10: inject[0]: bow/ping is an output; allowed: a process");
  CHECK(of("{drop: bow/ping, share: 2}") == "x.yaml:14:34: inject[0].share: 2 is outside [0, 1]");
  CHECK(of("{delay: bow/ping, by_ms: 1001, to_s: 9}") ==
        "x.yaml:14:10: inject[0]: by_ms is above 1000 in a delay that ends; allowed: up to 1000, or no to_s");
  CHECK(of("{delay: bow/ping, by_ms: 1001}").empty());
  CHECK(of("{pause: bow, at_s: 3, signal: KILL}") != "");
  CHECK(of("{shout: bow}") != "");
}

TEST_CASE("includes are merged before the file itself, with arguments of their own") {
  const Folder folder;
  folder.add("parts/sensors.yaml",
             "ensonify: launch/1\nargs: {rate: }\nprocesses:\n  nav: {run: navigation, config: {rate_hz: $(rate)}}\n"
             "clock: {window_s: 3}\n");
  folder.add("x.yaml", std::string(kLaunch) + "include: [{file: parts/sensors.yaml, args: {rate: 50}}]\n");
  const Launch launch = folder.read();
  CHECK(launch.processes[0].name == "nav");
  CHECK(to_json(launch.processes[0].config.root) == R"({"rate_hz":50})");
  CHECK(launch.clock.window_s == 3);

  folder.add("x.yaml", std::string(kLaunch) + "include: parts/sensors.yaml\n");
  CHECK(folder.problems() == "parts/sensors.yaml:2:8: args.rate: must be given; use --arg rate=VALUE");
  folder.add("parts/sensors.yaml", "ensonify: launch/1\ninclude: ../x.yaml\nprocesses: {auv: {run: vehicle}}\n");
  CHECK(folder.problems() ==
        "parts/sensors.yaml:2:10: include: \"../x.yaml\" includes itself, directly or through others\n"
        "x.yaml:5:3: processes.auv: is given twice, first at parts/sensors.yaml:3");
  folder.add("parts/sensors.yaml", "ensonify: launch/9\nbogus: 1\n");
  CHECK(folder.problems() ==
        "parts/sensors.yaml:1:11: ensonify: launch/9 is not a format known here; allowed: launch/1\n"
        "parts/sensors.yaml:2:1: bogus: is not a known key; known keys: after, clock, duration_s, ensonify, expect, "
        "inject, "
        "isa, processes, scenario, set, wiring");
}

TEST_CASE("mistakes in a launch file and its world are reported together") {
  const Folder folder;
  folder.add("world.yaml", replaced(kWorld, "layers", "sand"));
  folder.add("x.yaml", replaced(replaced(replaced(kLaunch, "bow.pose", "bwo.pose"), "cpus: [0, 1]", "cpus: [a]"),
                                "head.yaml", "haed.yaml"));
  CHECK(
      folder.problems({.args = {"rastr=x"}}) ==
      "--arg rastr: is not an argument of this launch file; did you mean raster?\n"
      "world.yaml:3:16: seabed.kind: is \"sand\", not one of layers, raster, tiles\n"
      "x.yaml:5:33: processes.auv.cpus[0]: is \"a\", not a number in [0, 4095]\n"
      "x.yaml:6:36: processes.bow.config: \"haed.yaml\": no such file or folder (searched beside this file and in the "
      "data folders)\n"
      "x.yaml:11:13: wiring.bwo.pose: no process is named bwo; did you mean bow?");
}

TEST_CASE("other mistakes in a launch file") {
  const Folder folder;
  const auto with = [&](const std::string& old_part, const std::string& new_part) {
    folder.add("x.yaml", replaced(kLaunch, old_part, new_part));
    return folder.problems();
  };
  CHECK(with("launch/1", "launch/2") ==
        "x.yaml:1:11: ensonify: launch/2 is not a format known here; allowed: launch/1");
  CHECK(with("$(gain)", "$(gian)") == "x.yaml:7:70: $(gian) is not declared under args; did you mean gain?");
  CHECK(with("auv:  ", "water:") ==
        "x.yaml:5:10: processes.water: is a reserved name; choose another\n"
        "x.yaml:10:16: wiring.auv.command: no process is named auv");
  CHECK(
      with("agent: { run", "A/b: { run") ==
      "x.yaml:8:8: processes.A/b: is not a process name; allowed: up to 32 of a-z, 0-9 and _, beginning with a letter");
  CHECK(with("run: vehicle", "run: ./vehicle") ==
        "x.yaml:5:17: processes.auv.run: \"./vehicle\" is not a component; a foreign program is written as a list");
  CHECK(with("{ run: vehicle", "{ respawn: true") ==
        "x.yaml:5:10: processes.auv.run: is missing; allowed: text\n"
        "x.yaml:5:21: processes.auv.respawn: is only for observers; a lost participant ends the run");
  CHECK(with("after: [[ensonify, plot, $(out)]]", "after: [plot]") ==
        "x.yaml:12:8: after: is not a list of commands, each a list of words");
  CHECK(with("delay_ms: 100", "delay_ms: -1") == "x.yaml:10:50: wiring.auv.command.delay_ms: -1 is outside [0, 1e+07]");
  CHECK(with("head.yaml", "world.yaml") == "");  // its keys are for the component to check
  folder.add("head.yaml", "a: [");
  CHECK(with("launch/1", "launch/1") == "head.yaml:1:1: is not YAML: end of sequence flow not found");
  CHECK(folder.problems({.file = "none.yaml"}) == "none.yaml: no such file");
  folder.add("x.yaml", "ensonify: launch/1\nprocesses: {}\n");
  CHECK(folder.problems() == "x.yaml:2:12: processes: names no process; a launch needs at least one");
}

TEST_CASE("an entry without a value is refused with its place, a wiring without entries is none") {
  const Folder folder;
  const auto with = [&](const std::string& old_part, const std::string& new_part) {
    folder.add("x.yaml", replaced(kLaunch, old_part, new_part));
    return folder.problems();
  };
  CHECK(with("  auv.command: { topic: agent/command, delay_ms: 100 }\n  bow.pose: auv/pose\n", "") == "");
  CHECK(with("bow.pose: auv/pose", "bow.pose:") ==
        "x.yaml:11:3: wiring.bow.pose: has no value; allowed: a map of keys");
  CHECK(with("{ run: multibeam, config: head.yaml }", "") ==
        "x.yaml:6:3: processes.bow: has no value; allowed: a map of keys");

  folder.add("x.yaml", kLaunch);
  folder.add("y.yaml", "ensonify: launch/1\ninclude: x.yaml\nwiring:\n");
  CHECK(folder.read({.file = "y.yaml"}).wiring.size() == 2);
}

TEST_CASE("bytes that are not UTF-8 are refused on the command line") {
  const Folder folder;
  CHECK(folder.problems({.args = {"raster=b\xff"}}) == "--arg raster=b?: is not UTF-8");
  CHECK(folder.problems({.args = {"r\xffster=b"}}) == "--arg r?ster=b: is not UTF-8");
  CHECK(folder.problems({.sets = {"bow.name=b\xff"}}) == "--set bow.name=b?: is not UTF-8");
}

TEST_CASE("a launch that no file could say is not written: one with $( in a value") {
  const Folder folder;
  const auto refused = [&](const LaunchOptions& options) {
    try {
      LaunchOptions printed = options;
      printed.out = "$(out)";
      const Launch launch = folder.read(printed);
      const std::string text =
          written_launch(launch, to_canonical_yaml(launch.scenario.document.root), [](const auto&) { return ""; });
      folder.add("again.yaml", text);
      CHECK(folder.problems({.file = "again.yaml"}) == "");
      return std::string();
    } catch (const ConfigError& error) {
      const std::string text = error.what();
      return text.substr(text.rfind('/', text.find(':')) + 1);
    }
  };
  CHECK(refused({}) == "");
  CHECK(refused({.args = {"raster=$(x)"}}) ==
        "x.yaml:7:50: processes.pager.config.raster: \"$(x)\" cannot be printed: in a launch file $( stands for an "
        "argument");
  folder.add("world.yaml", replaced(kWorld, "site: {", "site: {name: cost $(x), "));
  CHECK(refused({}) ==
        "world.yaml:2:14: scenario.site.name: \"cost $(x)\" cannot be printed: in a launch file $( stands for an "
        "argument");
}

TEST_CASE("the options of a launch survive being handed to another program") {
  LaunchOptions given{
      .file = "x.yaml", .args = {"a=b c"}, .sets = {"bow.x=[1, 2]", "seed=3"}, .record = "r.mcap", .out = "o"};
  CLI::App app;
  LaunchOptions read;
  add_options(app, read, false);
  auto arguments = to_arguments(given);
  std::reverse(arguments.begin(), arguments.end());  // CLI11 takes them last first
  app.parse(arguments);
  CHECK(read.file == given.file);
  CHECK(read.args == given.args);
  CHECK(read.sets == given.sets);
  CHECK(read.record == given.record);
  CHECK(read.out == given.out);
}

}  // namespace ensonify
