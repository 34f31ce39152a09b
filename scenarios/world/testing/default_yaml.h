#pragma once

#include <algorithm>
#include <cstdlib>
#include <string>
#include <vector>

#include "components/config/config_reader.h"
#include "scenarios/world/world.h"

namespace ensonify {

/// The same of a Config that reads less of the scenario than its World: `arguments` follow the reader.
template <class Config, class... Arguments>
std::string default_yaml_fault_of(const std::vector<std::string>& exempt, const Arguments&... arguments) {
  const std::string path = std::string(std::getenv("ENSONIFY_FOLDER")) + "/default.yaml";
  ConfigReader file = ConfigReader::from_file(path);
  ConfigReader nothing = ConfigReader::from_text("{}", "nothing.yaml");
  const Config written = Config::read(file, arguments...);
  const Config initial = Config::read(nothing, arguments...);
  file.finish();
  nothing.finish();
  for (const std::string& key : file.known_keys()) {
    if (!file.has(key) && std::find(exempt.begin(), exempt.end(), key) == exempt.end()) return path + " lacks " + key;
  }
  return written == initial ? "" : path + " has values other than the struct's initialisers";
}

/// For tests: "" when default.yaml beside the test lists every parameter of Config, each with the value that the
/// struct's initialiser gives it; otherwise what differs. `component` is the name of the process that asks, `exempt`
/// are parameters without a default. Config needs ==.
template <class Config>
std::string default_yaml_fault(const std::string& component, const World& world,
                               const std::vector<std::string>& exempt = {}) {
  return default_yaml_fault_of<Config>(exempt, world, component);
}

}  // namespace ensonify
