#pragma once

#include "components/config/parameter_info.h"
#include "components/errors/exit_error.h"
#include "launch/process/factory.h"

namespace ensonify {

/// The list of what a Config reads: its own, or that of the struct that it names as its Parameters.
template <class Config>
ParameterList list_of() {
  if constexpr (requires { typename Config::Parameters; }) {
    return parameters_of<typename Config::Parameters>();
  } else if constexpr (HasParameters<Config>) {
    return parameters_of<Config>();
  } else {
    return {};
  }
}

/// A component's main(): reads the launch file and this process's parameters, then either prints the ports (`--check`)
/// or takes part in the run; with `--parameters` it prints their list and ends. Returns the exit code; every error is
/// caught, reported and turned into one here.
int run_component(const char* component, const NodeFactory& factory, ParameterList (*list)(), int argc, char** argv);

/// `int main(int argc, char** argv) { return ensonify::run<MultibeamNode>(argc, argv); }`
template <class Node>
int run(int argc, char** argv) {
  return run_component(Node::kComponent, factory_of<Node>(), list_of<typename Node::Config>, argc, argv);
}

}  // namespace ensonify
