#pragma once

#include "components/multibeam/config.h"

namespace ensonify {

/// For tests and benchmarks: a head in isovelocity water of 1500 m/s over sand by Lambert's law.
inline MultibeamConfig head_in_plain_water() {
  MultibeamConfig config;
  config.world.water.profile.sound_speed_mps = 1500.0;
  config.world.water.absorption_dbpm = 0.07;
  config.world.water.noise_level_db = 35.0;
  config.world.seabed.sediments[0] = seabed::Lambert{-25.0};
  return config;
}

}  // namespace ensonify
