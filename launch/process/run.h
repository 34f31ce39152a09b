#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>

#include "components/config/parameter_info.h"
#include "components/config/read_parameters.h"
#include "components/errors/exit_error.h"
#include "components/runtime/stepper.h"
#include "launch/file/launch_file.h"

namespace ensonify {

/// Reads a process's parameters and constructs its node, which declares its ports. Throws ConfigError.
using NodeFactory = std::function<std::unique_ptr<AnyNode>(const Launch&, const ProcessSpec&, Ports&)>;

/// What a Config's read() takes decides what is read for it: its own parameters alone, with the scenario's header, or
/// with the whole World. A component that takes less links less.
template <class Config>
Config read_config(Config (*read)(ConfigReader&), ConfigReader& from, const Launch&, const ProcessSpec&) {
  return read(from);
}
template <class Config>
Config read_config(Config (*read)(ConfigReader&, const ScenarioHeader&), ConfigReader& from, const Launch& launch,
                   const ProcessSpec&) {
  return read(from, launch.scenario.header);
}
template <class Config>
Config read_config(Config (*read)(ConfigReader&, const ScenarioHeader&, const std::string& name), ConfigReader& from,
                   const Launch& launch, const ProcessSpec& process) {
  return read(from, launch.scenario.header, process.name);
}
template <class Config, class World>
Config read_config(Config (*read)(ConfigReader&, const World&, const std::string& name), ConfigReader& from,
                   const Launch& launch, const ProcessSpec& process) {
  return read(from, World::read(launch.scenario), process.name);
}

/// The factory of a node class.
template <class Node>
NodeFactory factory_of() {
  return [](const Launch& launch, const ProcessSpec& process, Ports& ports) -> std::unique_ptr<AnyNode> {
    ConfigReader from = process.reader();
    const typename Node::Config config = read_config(&Node::Config::read, from, launch, process);
    from.finish();
    return std::make_unique<NodeHolder<Node>>(config, ports);
  };
}

/// The list of what a Config reads: its own, or that of the struct that it names as its Parameters. Of a process it has
/// the values that the process's configuration gives, else the defaults.
template <class Config>
ParameterList list_of(const ProcessSpec* process) {
  if constexpr (requires { typename Config::Parameters; }) {
    return list_of<typename Config::Parameters>(process);
  } else if constexpr (HasParameters<Config>) {
    if (process == nullptr) return parameters_of<Config>();
    Config values;
    ConfigReader from = process->reader();
    read_parameters(from, values);
    return parameters_of(values, &from.node());
  } else {
    return {};
  }
}

/// A component's main(): reads the launch file and this process's parameters, then either prints the ports (`--check`)
/// or takes part in the run; with `--parameters` it prints their list and ends, with `--print` their values in this
/// launch. Returns the exit code; every error is caught, reported and turned into one here.
int run_component(const char* component, const NodeFactory& factory, ParameterList (*list)(const ProcessSpec*),
                  int argc, char** argv);

/// `int main(int argc, char** argv) { return ensonify::run<MultibeamNode>(argc, argv); }`
template <class Node>
int run(int argc, char** argv) {
  return run_component(Node::kComponent, factory_of<Node>(), list_of<typename Node::Config>, argc, argv);
}

/// Runs a whole launch in this process on the `local:` bus, one node after another, as fast as it goes: the same bytes
/// as separate processes, without sockets or threads of the runtime's. For tests, debuggers and ThreadSanitizer.
/// Foreign programs and external processes cannot take part: UserError names them. Returns the first exit code that is
/// not 0.
int run_local(const Launch& launch, const std::map<std::string, NodeFactory>& components);

/// main() of `ensonify-local`.
int local_main(int argc, char** argv, const std::map<std::string, NodeFactory>& components);

}  // namespace ensonify
