#pragma once

#include <map>
#include <string>
#include <vector>

#include "components/runtime/wiring.h"
#include "messages/value.h"

namespace ensonify::describe {

/// A kind of process, as its folder under components/ and its program's --check report.
struct ComponentFacts {
  std::string name;
  std::string about;         // first paragraph of its README
  std::string default_yaml;  // every parameter with its default
  // As an example launch file configures it, for ports follow from parameters.
  std::string example;  // "bow in launch/demo.yaml"; "" if no launch file uses the component
  std::vector<OutPort> outs;
  std::vector<LivePort> lives;
  std::vector<InPort> ins;
  std::map<std::string, msg::Value> declares;
  std::string no_ports_because;  // why the program could not report its ports
};

/// Names of the components whose programs stand beside this one, sorted.
std::vector<std::string> component_names();

/// A component's parameters as yaml, table or schema; runs its program.
std::string parameters_as(const std::string& form, const std::string& component);

/// JSON Schema of each component's parameters, by its name.
std::map<std::string, std::string> component_schemas();

/// Facts of a component; runs its program with --check.
ComponentFacts facts_of(const std::string& component);

}  // namespace ensonify::describe
