#include "launch/process/local.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "components/errors/exit_code.h"
#include "components/errors/exit_error.h"
#include "components/runtime/lockstep/local_bus.h"
#include "components/runtime/tool.h"
#include "launch/process/launch_wiring.h"
#include "launch/process/run.h"

namespace ensonify {

namespace {

/// All nodes of a launch on one bus, wired.
LocalBus bus_of(const Launch& launch, const std::map<std::string, NodeFactory>& components) {
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
  for (const Declaration& process : bus.declarations()) add_notes(facts, process);
  bus.connect(wire_rules(launch), process_places(launch), facts);
  return bus;
}

/// What a clock would write to clock.json of such a run.
void report(const Conductor& conductor, const Launch& launch) {
  const SimTime reached = std::min(conductor.now(), conductor.end());
  std::ofstream(launch.options.out + "/clock.json") << nlohmann::json{{"sim_s", seconds(reached)}} << '\n';
}

}  // namespace

int run_local(const Launch& launch, const std::map<std::string, NodeFactory>& components) {
  LocalBus bus = bus_of(launch, components);
  Conductor conductor = make_conductor(bus.graph(), bus.declarations(), launch);
  try {
    while (!conductor.finished()) bus.advance(conductor);
  } catch (...) {
    report(conductor, launch);
    throw;
  }
  report(conductor, launch);
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
