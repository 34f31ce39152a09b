#include "components/terrain_pager/config.h"

#include <algorithm>

#include "components/config/read_parameters.h"
#include "components/errors/exit_error.h"
#include "components/tracks/followed_track.h"

namespace ensonify {
namespace {

std::shared_ptr<const tracks::FollowedTrack> followed_in(const World& world, const Vehicle& vehicle) {
  const auto origin = world.site.origin_from_raster ? std::nullopt : std::optional(world.site.origin);
  try {
    return std::make_shared<const tracks::FollowedTrack>(
        tracks::followed_track(*world.mission.follow, origin, vehicle.fastest_mps));
  } catch (const UserError&) {
    return nullptr;
  }
}

}  // namespace

TerrainPagerConfig TerrainPagerConfig::read(ConfigReader& from, const World& world, const std::string&) {
  TerrainPagerConfig config;
  read_parameters<TerrainPagerParameters>(from, config);
  config.place = from.node().place;
  config.scenario_file = world.file;
  config.scenario_text = world.text;
  if (world.end_ns) config.duration = SimTime(*world.end_ns);
  config.terrain.site = world.site;
  config.terrain.seabed = world.seabed;
  config.objects = world.objects;
  config.mission = world.mission;
  config.vehicles = world.vehicles;
  if (const Vehicle* follows = follower(world)) {
    config.followed = followed_in(world, *follows);
    config.follower_name = follows->name;
  }
  config.tide = world.vertical.tide;
  if (!world.vehicles.empty()) config.fastest_mps = 0.0;
  for (const Vehicle& vehicle : world.vehicles) config.fastest_mps = std::max(config.fastest_mps, vehicle.fastest_mps);
  return config;
}

}  // namespace ensonify
