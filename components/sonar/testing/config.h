#pragma once

#include <string>

#include "components/config/config_reader.h"
#include "scenarios/world/world.h"

/// For tests of configurations of heads.
namespace ensonify {

/// A world whose one vehicle carries a head of this name.
inline World world_with(const std::string& head) {
  World world;
  Vehicle vehicle;
  vehicle.name = "auv";
  vehicle.mountings[head] = {};
  world.vehicles = {vehicle};
  return world;
}

/// What a head's reader says against this text; "" for nothing.
template <class Config>
std::string problems_of(const std::string& yaml) {
  auto from = ConfigReader::from_text(yaml, "head.yaml");
  Config::read(from, world_with("bow"), "bow");
  try {
    from.finish();
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

}  // namespace ensonify
