#pragma once

#include <algorithm>
#include <cstdlib>
#include <string>
#include <vector>

#include "components/config/config_reader.h"
#include "components/config/parameters.h"
#include "scenarios/world/world.h"

namespace ensonify {

/// For tests: "" when default.yaml beside the test lists every parameter of Config, each with the value that the
/// struct's initialiser gives it; otherwise what differs. `component` is the name of the process that asks, `exempt`
/// are parameters without a default. Config needs a list of parameters or ==.
template <class Config>
std::string default_yaml_fault(const std::string& component, const World& world,
                               const std::vector<std::string>& exempt = {}) {
  const std::string path = std::string(std::getenv("ENSONIFY_FOLDER")) + "/default.yaml";
  ConfigReader file = ConfigReader::from_file(path);
  ConfigReader nothing = ConfigReader::from_text("{}", "nothing.yaml");
  const Config written = Config::read(file, world, component);
  const Config initial = Config::read(nothing, world, component);
  file.finish();
  nothing.finish();
  for (const std::string& key : file.known_keys()) {
    if (!file.has(key) && std::find(exempt.begin(), exempt.end(), key) == exempt.end()) return path + " lacks " + key;
  }
  bool equal = false;
  if constexpr (HasParameters<Config>) {
    equal = equal_parameters(written, initial);
  } else {
    equal = written == initial;
  }
  return equal ? "" : path + " has values other than the struct's initialisers";
}

}  // namespace ensonify
