#pragma once

#include <functional>
#include <memory>

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

}  // namespace ensonify
