#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "components/config/config_node.h"
#include "components/config/config_reader.h"
#include "components/config/parameters.h"
#include "components/config/parse_yaml.h"
#include "components/runtime/injections.h"
#include "components/runtime/sim_time.h"
#include "kernels/base/isa/isa.h"
#include "scenarios/scenario_file.h"

namespace CLI {
class App;
}
namespace ensonify {

inline constexpr const char* kLaunchFormat = "launch/1";

/// Options of a launch on the command line. Whoever reads the same file with the same options gets the same
/// Launch: the launcher hands to_arguments() to every process.
struct LaunchOptions {
  std::string file;
  std::vector<std::string> args;  // "raster=FILE", arguments of the launch file
  std::vector<std::string> sets;  // "bow.frequency_hz=2e5": process, scenario section or clock, then the key
  std::string record;             // adds a recorder that writes this file; "" adds none
  std::string out = "out";        // folder of results, `$(out)` in launch files

  bool operator==(const LaunchOptions&) const = default;
};

/// Adds LAUNCH (or --launch, for the processes of a run), --arg, --set, --record and --out to a program's options.
void add_options(CLI::App& app, LaunchOptions& options, bool launch_is_positional);

/// The options that give another program the same launch: "--launch", FILE, "--arg", ...
std::vector<std::string> to_arguments(const LaunchOptions& options);

/// `run: multibeam` or `run: [python3, agent.py]`.
struct Program {
  std::string component;          // native: the program ensonify-<component>; "" for a foreign program
  std::vector<std::string> argv;  // of a foreign program

  Program& program() { return *this; }
  const Program& program() const { return *this; }
  void read(ConfigReader& from, const char* key);
  ConfigNode in_file() const;
  static std::string schema();
};

/// Parameters of a process: a map, or the file that has them. Each process checks its own.
struct ProcessConfig : ConfigDocument {
  std::string file;  // "": they stand in the launch file

  void read(ConfigReader& from, const char* key);
  ConfigNode in_file() const { return root; }
  static std::string schema() { return R"({"anyOf": [{"type": "string"}, {"type": "object"}]})"; }
};

/// Environment variables of a process.
struct EnvironmentVariables : std::map<std::string, std::string> {
  void read(ConfigReader& from, const char* key);
  ConfigNode in_file() const;
  static std::string schema();
};

/// One process of a launch.
struct ProcessSpec : Program {
  std::string name;
  static constexpr auto kNamedBy = &ProcessSpec::name;
  ProcessConfig config;     // its own parameters, with what --set says about them
  std::string config_path;  // put before keys in messages; "" when the parameters stand in a file of their own
  EnvironmentVariables env;
  std::vector<int> cpus;  // empty: any
  bool external = false;
  double join_s = 30.0;
  bool observer = false;
  bool respawn = false;
  bool may_be_lost = false;
  std::optional<double> memory_mb;  // most resident memory; nothing: only the run as a whole is bounded
  ConfigPlace place;                // of its stanza

  static void parameters(auto& self, auto&& visit) {
    visit("run", "", computed(any()), "a component, or a program and its arguments as a list", self.program());
    visit("external", "", any(), "process that the launcher does not start but awaits", self.external);
    visit("join_s", "s", in(0.01, 86400), "time for which an external process is awaited", self.join_s);
    visit("observer", "", any(), "process that may be lost without ending the run", self.observer);
    visit("respawn", "", any(), "observer that is started again", self.respawn);
    visit("may_be_lost", "", any(), "participant that the run goes on without once it has died or stood still",
          self.may_be_lost);
    visit("memory_mb", "MB", in(1, 1e9), "resident memory that it may hold, with what it starts; more ends the run",
          self.memory_mb);
    visit("cpus", "", computed(in(0, 4095)), "processors that it may run on", self.cpus);
    visit("env", "", computed(any()), "environment variables", self.env);
    visit("config", "", computed(any()), "parameters of the component, or the path of a file with them", self.config);
  }
  void check(const ConfigReader& from) const;
  void complete(ConfigReader& from);

  /// Reads this process's parameters: `Config::read(reader)`, then reader.finish().
  ConfigReader reader() const { return ConfigReader(static_cast<const ConfigDocument&>(config), config_path); }
};

/// An input wired by hand: `auv.command: {topic: agent/command, delay_ms: 100}`.
struct Connection {
  std::string process;
  std::string port;
  std::string topic;
  std::optional<SimTime> delay;  // may only lengthen the port's own delay
  ConfigPlace place;             // of the entry
};

struct ClockSettings {
  enum class SlipPolicy { kCount, kFail };
  enum class Transport { kIpc, kTcp };
  std::optional<double> rate;  // sim seconds per wall second; nothing: free running
  double window_s = 1.0;
  double slip_after_s = 0.5;
  SlipPolicy slip_policy = SlipPolicy::kCount;
  double progress_deadline_s = 10.0;
  Transport transport = Transport::kIpc;
  double connect_timeout_s = 30.0;
  std::string address = "127.0.0.1";
  int port = 0;
  bool keys = true;
  std::vector<std::string> allow;

  static void parameters(auto& self, auto&& visit) {
    visit("rate", "", or_word("free", in(1e-3, 1e6)), "sim seconds per wall second, or free: as fast as it goes",
          self.rate);
    visit("window_s", "s", in(0.01, 5.0), "sim time that a producer may run ahead of its consumers", self.window_s);
    visit("slip_after_s", "s", in(0, 1000), "lateness beyond which the pacing origin moves", self.slip_after_s);
    visit("slip_policy", "", one_of({{"count", SlipPolicy::kCount}, {"fail", SlipPolicy::kFail}}),
          "consequence of a slip for the run", self.slip_policy);
    visit("progress_deadline_s", "s", in(0.01, 3600),
          "wall time; a stall is warned at 1x, dumped at 3x and ends the run at 10x", self.progress_deadline_s);
    visit("transport", "", one_of({{"ipc", Transport::kIpc}, {"tcp", Transport::kTcp}}),
          "transport between the processes", self.transport);
    visit("connect_timeout_s", "s", in(0.01, 3600), "wall time until every process is there", self.connect_timeout_s);
    visit("address", "", computed(any()),
          "address of this machine, at which the clock and what runs beside it take part by tcp", self.address);
    visit("port", "", computed(in(0, 65535)), "port of the clock by tcp; 0: any that is free", self.port);
    visit("keys", "", computed(any()), "tcp: nobody takes part, or sees anything, without the run's keys", self.keys);
    visit("allow", "", computed(any()),
          "addresses or networks ([10.0.0.2, 10.0.1.0/24]) that may take part besides this machine", self.allow);
  }
  void check(const ConfigReader& from) const;
};

/// `exit: {process: agent, code: 3}` or `{process: agent, signal: KILL}` under `expect:`: how a process must end.
/// Judged by the launcher, who alone sees it.
struct ExitExpectation {
  std::string name;  // what it says, unless the user named it
  std::string process;
  int code = 0;    // when signal is 0
  int signal = 0;  // number
  ConfigNode given;
};

/// A command of `after:`.
struct AfterStep {
  std::vector<std::string> words;
  ConfigPlace place;
};

/// A launch file with its includes, arguments and overrides resolved.
struct Launch {
  std::string file;
  LaunchOptions options;
  ScenarioFile scenario;
  std::vector<ProcessSpec> processes;  // publishers rank in this order
  std::vector<Connection> wiring;
  ClockSettings clock;
  std::optional<Isa> isa;  // nothing: the widest that the machine has
  std::vector<Injection> injections;
  std::vector<ExitExpectation> exits;
  std::vector<AfterStep> after;     // commands to run when all went well
  std::optional<SimTime> duration;  // hard end, sim time
  /// Facts of the run as YAML without places, absolute paths, output folder or anything that does not change results
  /// (pacing, CPUs, environment): equal runs have equal texts.
  std::string launch_text;

  /// By name; throws std::out_of_range.
  const ProcessSpec& process(const std::string& name) const;
};

/// Vector instructions that processes of the launch use on this machine. Throws ConfigError where it has not those that
/// the launch file wants.
Isa isa_of(const Launch& launch);

/// Reads a scenario further than its header: given its reader, which finish() completes, and its file.
using ReadScenario = std::function<void(ConfigReader&, const std::string& file)>;

/// Reads a launch file and the header of its scenario. Throws ConfigError with every problem, those that
/// `read_scenario` adds among them. The processes' own parameters are parsed here but checked by each process.
Launch read_launch(const LaunchOptions& options, const ReadScenario& read_scenario = {});

/// Launch::launch_text of a launch whose `$(out)` has not been put in yet.
std::string canonical_text(const Launch& launch);

/// A process's configuration with every value, as lines of YAML; "": as it was given.
using WrittenConfig = std::function<std::string(const ProcessSpec&)>;
/// What a launch file would have with every value and its sentence. `scenario` is read_world()'s `written`, and stands
/// in it; "": it names none. Throws ConfigError where a value holds $(, but for $(out).
std::string written_launch(const Launch& launch, const std::string& scenario, const WrittenConfig& config_of);

/// JSON Schema of launch files, for editors. `components` has the JSON Schema of each component's parameters by its
/// name; others' `config` may hold anything. `scenario` is that of scenario files. Every value may be an argument,
/// $(name).
std::string launch_schema(const std::map<std::string, std::string>& components, const std::string& scenario);

}  // namespace ensonify
