#pragma once

#include <memory>
#include <string>
#include <utility>

#include "components/config/config_reader.h"
#include "components/sonar/head_config.h"
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

/// The world of a head's configuration, to change it: from now on one of its own.
inline World& world_of(HeadPlace& config) {
  auto own = std::make_shared<World>(*config.world);
  World& world = *own;
  config.world = std::move(own);
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
