#include "components/terrain_pager/config.h"

#include <catch2/catch.hpp>
#include <cstdlib>

#include "components/config/config_reader.h"

using namespace ensonify;

TEST_CASE("default.yaml of the pager says what the struct says") {
  const std::string source = std::getenv("ENSONIFY_SOURCE");
  auto from = ConfigReader::from_file(source + "/components/terrain_pager/default.yaml");
  const auto read = TerrainPagerConfig::read(from, World{}, "pager");
  from.finish();
  const TerrainPagerConfig d;
  CHECK(read.rate_hz == d.rate_hz);
  CHECK(read.feed_margin_m == d.feed_margin_m);
  CHECK(read.release_hysteresis_m == d.release_hysteresis_m);
  CHECK(read.wide_margin_m == d.wide_margin_m);
  CHECK(read.budget_mb == d.budget_mb);
  CHECK(read.head_budget_mb == d.head_budget_mb);
  CHECK(read.load_ahead_s == d.load_ahead_s);
  CHECK(read.threads == d.threads);
  CHECK(read.corridor_half_deg == d.corridor_half_deg);
  CHECK(read.cache_mb == d.cache_mb);
  CHECK(read.cache_folder == d.cache_folder);
  CHECK(read.terrain.raster_crs == d.terrain.raster_crs);
  CHECK(read.terrain.raster_band == d.terrain.raster_band);
  CHECK(read.terrain.raster_nodata == d.terrain.raster_nodata);
}
