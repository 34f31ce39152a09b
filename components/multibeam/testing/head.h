#pragma once

#include "components/multibeam/config.h"
#include "components/sonar/testing/config.h"

namespace ensonify {

/// For tests and benchmarks: a head in isovelocity water of 1500 m/s over sand by Lambert's law.
inline MultibeamConfig head_in_plain_water() {
  MultibeamConfig config;
  world_of(config).water.profile.sound_speed_mps = 1500.0;
  world_of(config).water.absorption_dbpm = 0.07;
  world_of(config).water.noise_level_db = 35.0;
  world_of(config).seabed.sediments[0] = seabed::Lambert{-25.0};
  return config;
}

}  // namespace ensonify
