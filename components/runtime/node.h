#pragma once

#include <functional>
#include <memory>

#include "components/runtime/config/launch_file.h"
#include "components/runtime/ports.h"

namespace ensonify {

/// A component's node behind one interface: what the participant's loop and the in-process runner drive.
class AnyNode {
 public:
  virtual ~AnyNode() = default;
  virtual SimTime step(SimTime now) = 0;
  /// The run has ended in order: files are completed here, where an error can still be told.
  virtual void finish_run() = 0;
  /// What the process exits with after an orderly end.
  virtual int exit_code() const = 0;
};

/// Reads a process's parameters and constructs its node, which declares its ports. Throws ConfigError.
using NodeFactory = std::function<std::unique_ptr<AnyNode>(const Launch&, const ProcessSpec&, Ports&)>;

template <class Node>
class NodeHolder : public AnyNode {
 public:
  NodeHolder(const typename Node::Config& config, Ports& ports) : node_(config, ports) {}
  SimTime step(SimTime now) override { return node_.step(now); }
  void finish_run() override {
    if constexpr (requires { node_.finish_run(); }) node_.finish_run();
  }
  int exit_code() const override {
    if constexpr (requires { node_.exit_code(); }) return node_.exit_code();
    else return 0;
  }

 private:
  Node node_;
};

/// The factory of a node class: its Config reads the process's own parameters and, from the scenario, the world. A
/// Config with a scenario_text is given the scenario as it is recorded, one with a duration the run's.
template <class Node>
NodeFactory factory_of() {
  return [](const Launch& launch, const ProcessSpec& process, Ports& ports) -> std::unique_ptr<AnyNode> {
    ConfigReader from = process.reader();
    auto config = Node::Config::read(from, launch.scenario, process.name);
    from.finish();
    if constexpr (requires { config.scenario_text; }) config.scenario_text = launch.scenario_text;
    if constexpr (requires { config.duration; }) config.duration = launch.duration;
    return std::make_unique<NodeHolder<Node>>(config, ports);
  };
}

}  // namespace ensonify
