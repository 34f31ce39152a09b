#pragma once

#include <string>
#include <vector>

#include "components/runtime/config/scenario.h"
#include "components/runtime/terrain/source_of.h"

namespace ensonify {

class ConfigReader;

/// What the pager is told: its own parameters and, from the scenario, which seabed and where the survey goes.
struct TerrainPagerConfig {
  int rate_hz = 2;                     // how often it looks where the vehicle is
  double feed_margin_m = 0.0;          // heads hold tiles nearer than this; 0: three times the greatest depth + 20 m
  double release_hysteresis_m = 50.0;  // and give them up when farther than feed margin + this
  double load_ahead_s = 60.0;          // tiles are fetched into memory for as far as the vehicle goes in this time
  int threads = 2;                     // that fetch
  double corridor_half_deg = 65.0;     // holes matter within this angle either side of nadir along the runlines

  // From the scenario.
  std::string scenario_file;
  source::TerrainOptions terrain;
  Mission mission;

  static TerrainPagerConfig read(ConfigReader& from, const Scenario& scenario, const std::string& process);
};

}  // namespace ensonify
