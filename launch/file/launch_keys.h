#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "components/config/read_parameters.h"
#include "components/runtime/injections.h"
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

// One entry of `inject:`: a fault, by the word that names it.
struct MuteKeys {
  static constexpr auto kKind = Injection::Kind::kMute;
  std::string target;
  double from_s = 0.0;
  std::optional<double> to_s;

  static void parameters(auto& self, auto&& visit) {
    visit("mute", "", must(any()), "output (PROCESS/PORT), or process, that publishes nothing", self.target);
    visit("from_s", "s", in(0, 1e7), "sim time from which on", self.from_s);
    visit("to_s", "s", in(0, 1e7), "sim time until which; left out: to the end", self.to_s);
  }
};
struct DropKeys {
  static constexpr auto kKind = Injection::Kind::kDrop;
  std::string target;
  double share = 1.0, from_s = 0.0;
  std::optional<double> to_s;

  static void parameters(auto& self, auto&& visit) {
    visit("drop", "", must(any()), "output, or process, whose messages are lost at random", self.target);
    visit("share", "", must(in(0, 1)), "probability with which each is lost", self.share);
    visit("from_s", "s", in(0, 1e7), "sim time from which on", self.from_s);
    visit("to_s", "s", in(0, 1e7), "sim time until which; left out: to the end", self.to_s);
  }
};
struct DelayKeys {
  static constexpr auto kKind = Injection::Kind::kDelay;
  std::string target;
  double by_s = 0.0, from_s = 0.0;
  std::optional<double> to_s;

  static void parameters(auto& self, auto&& visit) {
    visit("delay", "", must(any()), "output, or process, whose messages come later", self.target);
    visit("by_ms", "ms", must(in(1, 60e3)), "delay, to the publisher's next event after it", self.by_s);
    visit("from_s", "s", in(0, 1e7), "sim time from which on", self.from_s);
    visit("to_s", "s", in(0, 1e7), "sim time until which; left out: to the end", self.to_s);
  }
};
struct CorruptKeys {
  static constexpr auto kKind = Injection::Kind::kCorrupt;
  std::string target, field, value;
  double from_s = 0.0;
  std::optional<double> to_s;

  static void parameters(auto& self, auto&& visit) {
    visit("corrupt", "", must(any()), "output, or process, with a wrong value in each message", self.target);
    visit("field", "", must(any()), "path of a value that is no array: position_enu_m.2", self.field);
    visit("value", "", must(any()), "the value in its place: a number, nan, a text", self.value);
    visit("from_s", "s", in(0, 1e7), "sim time from which on", self.from_s);
    visit("to_s", "s", in(0, 1e7), "sim time until which; left out: to the end", self.to_s);
  }
};
struct KillKeys {
  static constexpr auto kKind = Injection::Kind::kKill;
  std::string target;
  double at_s = 0.0;
  enum class Signal { kAbort = 6, kKill = 9, kSegmentation = 11, kTerminate = 15 };  // as Linux counts them
  Signal signal = Signal::kKill;

  static void parameters(auto& self, auto&& visit) {
    visit("kill", "", must(any()), "process that is killed", self.target);
    visit("at_s", "s", must(in(0, 1e7)), "sim time before which its last event is", self.at_s);
    visit("signal", "",
          one_of({{"KILL", Signal::kKill},
                  {"TERM", Signal::kTerminate},
                  {"SEGV", Signal::kSegmentation},
                  {"ABRT", Signal::kAbort}}),
          "signal that ends it", self.signal);
  }
};
struct PauseKeys {
  static constexpr auto kKind = Injection::Kind::kPause;
  std::string target;
  double at_s = 0.0, for_wall_s = 1.0;

  static void parameters(auto& self, auto&& visit) {
    visit("pause", "", must(any()), "process that is stopped, and goes on", self.target);
    visit("at_s", "s", must(in(0, 1e7)), "sim time before which its last event is", self.at_s);
    visit("for_wall_s", "s", must(in(1e-3, 3600)), "wall time for which it stands still", self.for_wall_s);
  }
};
struct InjectKeys {
  std::variant<MuteKeys, DropKeys, DelayKeys, CorruptKeys, KillKeys, PauseKeys> fault;
  ConfigPlace place;

  static void parameters(auto& self, auto&& visit) { visit(one_form("needs one of {}"), self.fault); }
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
  std::optional<Isa> isa;
  std::optional<double> duration_s;
  std::vector<InjectKeys> inject;
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
    visit("isa", "", or_word("best", one_of({{"avx2", Isa::kAvx2}, {"avx512", Isa::kAvx512}})),
          "vector instructions that rays are traced with; best: the widest of the machine, whose last bits may differ",
          self.isa);
    visit("duration_s", "s", in(1e-3, 1e7), "the run's end, sim time", self.duration_s);
    visit("inject", "faults at a sim time", self.inject);
    visit("expect", "", computed(any()), "list of what must hold for the run to succeed", self.expect);
    visit("after", "", computed(any()), "commands to run when all went well", self.after);
  }
};

}  // namespace ensonify
