#pragma once

#include <optional>
#include <string>
#include <vector>

#include "components/config/config_error.h"
#include "components/runtime/sim_time.h"
#include "components/terrain/source_of.h"
#include "scenarios/world/world.h"

namespace ensonify {

class ConfigReader;

/// Configuration of the pager: its own parameters and, from the scenario, which seabed and where the survey goes.
struct TerrainPagerConfig {
  int rate_hz = 2;                     // how often it checks where the vehicle is
  double feed_margin_m = 0.0;          // heads hold tiles nearer than this; 0: as far as they can receive (demand.h)
  double release_hysteresis_m = 50.0;  // and give them up when farther than feed margin + this
  double wide_margin_m = 100.0;        // memory has tiles nearer than feed margin + this to the predicted track
  double load_ahead_s = 60.0;          // which is followed for so long
  int threads = 2;                     // that fetch
  double budget_mb = 512.0;            // tiles in memory weigh at most so much
  double head_budget_mb = 336.0;       // and those that heads hold so much
  double corridor_half_deg = 65.0;     // holes matter within this angle either side of nadir along the runlines
  double cache_mb = 0.0;               // made tiles are kept on disk up to so much; 0: none are
  std::string cache_folder;            // there; "": tile_cache_folder() of data_paths.h

  ConfigPlace place;  // of these parameters, for messages

  // From the scenario.
  std::string scenario_file;
  std::string scenario_text;        // canonical, as it is recorded; empty without a launch
  std::optional<SimTime> duration;  // of the run, where it has an end of its own
  source::TerrainOptions terrain;
  Mission mission;
  std::vector<Vehicle> vehicles;
  vertical::Tide tide;
  double fastest_mps = 10.0;  // of all vehicles

  static TerrainPagerConfig read(ConfigReader& from, const World& world, const std::string& process);
};

}  // namespace ensonify
