#pragma once

#include "components/errors/exit_error.h"
#include "launch/process/factory.h"

namespace ensonify {

/// A component's main(): reads the launch file and this process's parameters, then either prints the ports (`--check`)
/// or takes part in the run. Returns the exit code; every error is caught, reported and turned into one here.
int run_component(const char* component, const NodeFactory& factory, int argc, char** argv);

/// `int main(int argc, char** argv) { return ensonify::run<MultibeamNode>(argc, argv); }`
template <class Node>
int run(int argc, char** argv) {
  return run_component(Node::kComponent, factory_of<Node>(), argc, argv);
}

}  // namespace ensonify
