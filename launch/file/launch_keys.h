#pragma once

#include <optional>
#include <string>
#include <vector>

#include "components/config/read_parameters.h"
#include "launch/file/launch_file.h"

/// A launch file as it is written: one list of all that may stand in it.
namespace ensonify {

/// `scenario: FILE`, or the scenario itself.
struct ScenarioPlace {
  std::string path;  // as found; "": none, or it stands in the launch file
  ConfigNode map;    // null unless it does

  void read(ConfigReader& from, const char* key);
  ConfigNode in_file() const { return map; }
  static std::string schema() { return R"({"type": ["string", "object"]})"; }  // launch_schema() says more
};

// What the tree has lost before it is read: includes and arguments are put in, overrides applied (tree.h).
struct IncludeKey {
  void read(ConfigReader&, const char*) {}
  ConfigNode in_file() const { return {}; }
  static std::string schema();
};
struct ArgumentsKey {
  void read(ConfigReader&, const char*) {}
  ConfigNode in_file() const { return {}; }
  static std::string schema();
};
struct OverridesKey {
  void read(ConfigReader& from, const char* key) { from.node(key); }
  ConfigNode in_file() const { return {}; }
  static std::string schema() { return R"({"type": "object"})"; }
};

/// `auv.command: agent/command`, or a map.
struct ConnectionKeys {
  static constexpr const char* kShort = "topic";
  std::string input;
  static constexpr auto kNamedBy = &ConnectionKeys::input;
  std::string topic;
  std::optional<double> delay_s;
  ConfigPlace place;

  static void parameters(auto& self, auto&& visit) {
    visit("topic", "", must(any()), "PROCESS/PORT of the output", self.topic);
    visit("delay_ms", "ms", in(0, 1e7), "delay in place of the port's own, which it may only lengthen", self.delay_s);
  }
  void complete(ConfigReader& from) { place = from.node().place; }
};

/// The component `expect` reads the list, but for how processes end.
struct ExpectKey {
  ConfigNode list;  // null: there is none

  void read(ConfigReader& from, const char* key);
  ConfigNode in_file() const { return list; }
  static std::string schema() { return R"({"type": "array"})"; }
};

struct AfterKey {
  std::vector<AfterStep> steps;

  void read(ConfigReader& from, const char* key);
  ConfigNode in_file() const;
  static std::string schema();
};

struct LaunchKeys {
  static constexpr const char* kFormat = kLaunchFormat;
  FormatKey<LaunchKeys> format;
  ArgumentsKey args;
  IncludeKey include;
  ScenarioPlace scenario;
  OverridesKey set;
  std::vector<ProcessSpec> processes;
  std::vector<ConnectionKeys> wiring;
  ClockSettings clock;
  std::optional<double> duration_s;
  ExpectKey expect;
  AfterKey after;

  static void parameters(auto& self, auto&& visit) {
    visit("ensonify", "", must(any()), "the format", self.format);
    visit("args", "", again(any()), "arguments with their defaults; null: must be given", self.args);
    visit("include", "", again(any()), "launch files that this one goes on from", self.include);
    visit("scenario", "", computed(any()), "path of the scenario, or the scenario itself", self.scenario);
    visit("set", "", again(any()), "changes of parameters: PROCESS.KEY or SECTION.KEY to a value", self.set);
    visit("processes", "processes that run together, by names of your own", self.processes);
    visit("wiring", "PROCESS.PORT of an input to the topic that it takes", self.wiring);
    visit("clock", "pacing and supervision", self.clock);
    visit("duration_s", "s", in(1e-3, 1e7), "the run's end, sim time", self.duration_s);
    visit("expect", "", computed(any()), "list of what must hold for the run to succeed", self.expect);
    visit("after", "", computed(any()), "commands to run when all went well", self.after);
  }
};

}  // namespace ensonify
