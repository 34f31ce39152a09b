#include "components/terrain_pager/config.h"

#include <algorithm>

#include "components/config/config_reader.h"

namespace ensonify {

TerrainPagerConfig TerrainPagerConfig::read(ConfigReader& from, const World& world, const std::string&) {
  TerrainPagerConfig config;
  from.optional("rate_hz", config.rate_hz, 1, 20);
  from.optional("feed_margin_m", config.feed_margin_m, 0, 50e3);
  from.optional("release_hysteresis_m", config.release_hysteresis_m, 0, 50e3);
  from.optional("wide_margin_m", config.wide_margin_m, 0, 50e3);
  from.optional("load_ahead_s", config.load_ahead_s, 1, 3600);
  from.optional("threads", config.threads, 1, 64);
  from.optional("budget_mb", config.budget_mb, 1, 1e6);
  from.optional("head_budget_mb", config.head_budget_mb, 1, 1e6);
  from.optional("corridor_half_deg", config.corridor_half_deg, 0, 85);
  from.optional("cache_mb", config.cache_mb, 0, 1e5);
  from.optional("cache_folder", config.cache_folder);
  from.optional("raster_crs", config.terrain.raster_crs);
  from.optional("raster_band", config.terrain.raster_band, 1, 1000);
  from.optional("raster_nodata", config.terrain.raster_nodata);

  config.place = from.node().place;
  config.scenario_file = world.file;
  config.scenario_text = world.text;
  if (world.end_ns) config.duration = SimTime(*world.end_ns);
  config.terrain.site = world.site;
  config.terrain.seabed = world.seabed;
  config.mission = world.mission;
  config.vehicles = world.vehicles;
  config.tide = world.vertical.tide;
  if (!world.vehicles.empty()) config.fastest_mps = 0.0;
  for (const Vehicle& vehicle : world.vehicles) config.fastest_mps = std::max(config.fastest_mps, vehicle.fastest_mps);
  return config;
}

}  // namespace ensonify
