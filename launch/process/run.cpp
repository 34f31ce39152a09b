#include "launch/process/run.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "components/errors/exit_code.h"
#include "components/errors/exit_error.h"
#include "components/runtime/declared.h"
#include "components/runtime/lockstep/local_bus.h"
#include "components/runtime/participant.h"
#include "components/runtime/protocol.h"
#include "components/runtime/termination.h"
#include "components/runtime/tool.h"
#include "launch/process/launch_wiring.h"
#include "launch/process/profiled_node.h"

namespace ensonify {

namespace {

struct Options {
  LaunchOptions launch;
  std::string name;
  std::string clock;
  std::string run_dir;
  std::string keys;
  bool check = false;
  bool print = false;
};

/// Prints what a component's parameters are, as `ensonify describe` and the project's own pages have them.
void print_parameters(const std::string& component, const ParameterList& list, const std::string& form) {
  const std::string text = form == "yaml"    ? default_yaml(component + ": every parameter with its default", list)
                           : form == "table" ? parameter_table(list)
                                             : parameter_schema(component, list);
  fmt::print("{}", text);
}

/// Returns an exit code if the program is to end here (help, bad arguments, a list of parameters).
std::optional<int> parse(const char* component, ParameterList (*list)(const ProcessSpec*), int argc, char** argv,
                         Options& options) {
  CLI::App app(
      fmt::format("ensonify-{}: one process of a run. `ensonify run` starts it; docs/manual/wire.md says how it "
                  "talks, `ensonify describe {}` what it takes.",
                  component, component));
  add_options(app, options.launch, false);
  app.add_option("--name", options.name, "name of this process in the launch file")->required();
  app.add_option("--clock", options.clock, "endpoint of the clock; else read from the run directory");
  app.add_option("--run-dir", options.run_dir, "private directory of the run, for sockets");
  app.add_option(
      "--keys", options.keys,
      "the run's keys, a copy of keys.json in its run directory (default: there; without one, $ENSONIFY_KEYS)");
  app.add_flag("--check", options.check, "read the configuration, print the ports as JSON and exit");
  app.add_flag("--print", options.print, "read the configuration, print it with every value as YAML and exit");
  app.add_option_function<std::string>(
         "--parameters",
         [=](const std::string& form) {
           print_parameters(component, list(nullptr), form);
           throw CLI::Success();
         },
         "print the parameters with their defaults as yaml, table (Markdown) or schema (JSON Schema) and exit")
      ->check(CLI::IsMember({"yaml", "table", "schema"}))
      ->trigger_on_parse();
  return parse_command_line(app, argc, argv);
}

/// The configuration of a process with every value that the list knows; what else it has as it was given.
void print_configuration(const ParameterList& values, const ProcessSpec& process) {
  ConfigNode others = ConfigNode::map();
  for (const auto& entry : process.config.root.entries) {
    if (!lists_key(values, entry.key)) others.set(entry.key, entry.value);
  }
  fmt::print("{}{}", written_yaml(values), block_yaml(others));
}

/// The clock's address: given, or as the run directory says.
std::string clock_of(const Options& options) {
  if (!options.clock.empty()) return options.clock;
  std::string endpoint;
  std::ifstream(options.run_dir + "/clock.endpoint") >> endpoint;
  if (endpoint.empty()) {
    throw UserError("--run-dir: " + options.run_dir + " holds no clock.endpoint; `ensonify run` starts processes");
  }
  return endpoint;
}

/// Where the run's clock is, and how this process is reached.
Meeting meeting_of(const Options& options, const ClockSettings& settings) {
  const std::string clock = clock_of(options);
  bus::Address address;
  address.tcp = settings.transport == ClockSettings::Transport::kTcp;
  address.run_dir = options.run_dir;
  address.keys = bus::keys_for(clock, options.keys, options.run_dir);
  if (address.tcp) address.host = bus::host_towards(clock);
  if (address.tcp && settings.keys && !address.keys) {
    throw UserError("--keys: the run at " + clock + " has keys; give a copy of keys.json in its run directory");
  }
  return {clock, address};
}

int run_process(const char* component, const NodeFactory& factory, ParameterList (*list)(const ProcessSpec*),
                const Options& options) {
  Launch launch = read_launch(options.launch);
  if (options.print) {
    const ProcessSpec& process = launch.process(options.name);
    print_configuration(list(&process), process);
    return kExitOk;
  }
  use_isa(isa_of(launch));
  const bool profiled = std::getenv(kProfileVariable) != nullptr;
  const OpenSession open = [&](const EpochOptions& epoch) {
    if (!epoch.out.empty()) launch = read_launch(options_of(epoch, options.launch));
    const MakeNode make = [&](Ports& ports) -> std::unique_ptr<AnyNode> {
      std::unique_ptr<AnyNode> node = factory(launch, launch.process(options.name), ports);
      if (profiled) return std::make_unique<ProfiledNode>(std::move(node));
      return node;
    };
    return std::make_unique<Session>(component, options.name, launch.options.out, make);
  };
  if (options.check) {
    std::puts(protocol::declaration_json(open({})->declaration()).c_str());
    return kExitOk;
  }
  const int code = participate(open, meeting_of(options, launch.clock));
  if (profiled) write_profile(profile_folder(options.launch.out) + "/" + options.name + ".json", options.name);
  return code;
}

/// All nodes of a launch on one bus, wired.
LocalBus bus_of(const Launch& launch, const std::map<std::string, NodeFactory>& components) {
  use_isa(isa_of(launch));
  LocalBus bus;
  for (const ProcessSpec& process : launch.processes) {
    if (process.observer) continue;
    const auto factory = components.find(process.component);
    if (process.external || factory == components.end()) {
      throw UserError(process.name + ": only components of Ensonify can run in this process, not " +
                      (process.external            ? "an external process"
                       : process.component.empty() ? "the program " + process.argv.front()
                                                   : process.component));
    }
    bus.add(process.name, process.component, launch.options.out,
            [&](Ports& ports) { return factory->second(launch, process, ports); });
  }
  auto facts = facts_of(launch);
  facts[kDeclarationsFact] = declarations_json(bus.declarations());
  bus.connect(wire_rules(launch), process_places(launch), facts);
  return bus;
}

/// What a clock would write to clock.json of such a run.
void report(const Conductor& conductor, const Launch& launch) {
  const SimTime reached = std::min(conductor.now(), conductor.end());
  std::ofstream(launch.options.out + "/clock.json") << nlohmann::json{{"sim_s", seconds(reached)}} << '\n';
}

}  // namespace

int run_component(const char* component, const NodeFactory& factory, ParameterList (*list)(const ProcessSpec*),
                  int argc, char** argv) {
  Options options;
  if (const auto code = parse(component, list, argc, argv, options)) return *code;
  return exit_code_of([&] { return run_process(component, factory, list, options); });
}

int run_local(const Launch& launch, const std::map<std::string, NodeFactory>& components) {
  const Termination termination([] {});  // before nodes have threads
  LocalBus bus = bus_of(launch, components);
  Conductor conductor = make_conductor(bus.graph(), bus.declarations(), launch);
  try {
    while (!conductor.finished() && !termination.asked()) bus.advance(conductor);
  } catch (...) {
    report(conductor, launch);
    throw;
  }
  report(conductor, launch);
  if (termination.asked()) return kExitInterrupted;
  return bus.finish();
}

int local_main(int argc, char** argv, const std::map<std::string, NodeFactory>& components) {
  CLI::App app("ensonify-local: a whole launch in one process, for tests and debuggers; `ensonify run --in-process`.");
  LaunchOptions options;
  add_options(app, options, false);
  if (const auto code = parse_command_line(app, argc, argv)) return *code;
  return exit_code_of([&] { return run_local(read_launch(options), components); });
}

}  // namespace ensonify
