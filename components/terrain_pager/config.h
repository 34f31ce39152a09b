#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "components/config/config_error.h"
#include "components/config/parameters.h"
#include "components/runtime/sim_time.h"
#include "components/terrain/source_of.h"
#include "scenarios/world/world.h"

namespace ensonify {

class ConfigReader;
namespace tracks {
class FollowedTrack;
}

struct TerrainPagerParameters {
  int rate_hz = 2;
  double feed_margin_m = 0.0;
  double release_hysteresis_m = 50.0;
  double wide_margin_m = 100.0;
  double load_ahead_s = 60.0;
  int threads = 2;
  double budget_mb = 512.0;
  double head_budget_mb = 336.0;
  double corridor_half_deg = 65.0;
  double cache_mb = 0.0;
  std::string cache_folder;
  source::TerrainOptions terrain;  // whose site and seabed are the scenario's

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("rate_hz", "Hz", in(1, 20), "checks per second of where the vehicle is", self.rate_hz);
    visit("feed_margin_m", "m", in(0, 50e3),
          "heads hold tiles nearer than this to the vehicle; 0: as far as they can receive", self.feed_margin_m);
    visit("release_hysteresis_m", "m", in(0, 50e3), "distance beyond the feed margin at which tiles are given up",
          self.release_hysteresis_m);
    visit("wide_margin_m", "m", in(0, 50e3),
          "tiles are fetched into memory that come nearer than feed margin + this to the predicted track",
          self.wide_margin_m);
    visit("load_ahead_s", "s", in(1, 3600), "time for which the vehicle's velocity is followed ahead",
          self.load_ahead_s);
    visit("threads", "", in(1, 64), "threads that fetch", self.threads);
    visit("budget_mb", "MB", in(1, 1e6),
          "tiles in memory weigh at most so much; the least recently needed or insonified go first", self.budget_mb);
    visit("head_budget_mb", "MB", in(1, 1e6), "margins at which heads would hold more are refused",
          self.head_budget_mb);
    // Stays in degrees.
    visit("corridor_half_deg", "", in(0, 85),
          "degrees either side of nadir along the runlines within which holes matter", self.corridor_half_deg);
    visit("cache_mb", "MB", in(0, 1e5),
          "tiles of a generated seabed are kept on disk, up to so much, for the next start; 0: none are",
          self.cache_mb);
    visit("cache_folder", "", any(),
          "folder of the cache; \"\": $XDG_CACHE_HOME/ensonify/tiles, or ~/.cache/ensonify/tiles. May be deleted at "
          "any time",
          self.cache_folder);
    visit("raster_crs", "", any(), "reference system of a raster that names none (or a wrong one), e.g. EPSG:32619",
          self.terrain.raster_crs);
    visit("raster_band", "", in(1, 1000), "the raster's band that has the heights", self.terrain.raster_band);
    visit("raster_nodata", "", any(), "mark of missing values in a raster that declares none, e.g. -9999",
          self.terrain.raster_nodata);
  }
};

/// Configuration of the pager: its own parameters and, from the scenario, which seabed and where the survey goes.
struct TerrainPagerConfig : TerrainPagerParameters {
  ConfigPlace place;  // of these parameters, for messages

  // From the scenario.
  std::string scenario_file;
  std::string scenario_text;        // canonical, as it is recorded; empty without a launch
  std::optional<SimTime> duration;  // of the run, where it has an end of its own
  std::vector<SceneObject> objects;
  Mission mission;
  std::vector<Vehicle> vehicles;
  /// The track that the mission follows, and by which of `vehicles`. One that cannot be followed is the vehicle's to
  /// report.
  std::shared_ptr<const tracks::FollowedTrack> followed;
  std::string follower_name;
  vertical::Tide tide;
  double fastest_mps = 10.0;  // of all vehicles

  static TerrainPagerConfig read(ConfigReader& from, const World& world, const std::string& process);
};

}  // namespace ensonify
