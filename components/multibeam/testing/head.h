#pragma once

#include "components/multibeam/head.h"
#include "components/sonar/testing/config.h"
#include "components/sonar/testing/ping.h"

namespace ensonify {

/// For tests and benchmarks: a head in isovelocity water of 1500 m/s over sand by Lambert's law, with a preview's rays.
inline MultibeamConfig head_in_plain_water() {
  MultibeamConfig config;
  config.quality = 0.25;
  world_of(config).water.profile.sound_speed_mps = 1500.0;
  world_of(config).water.absorption_dbpm = 0.07;
  world_of(config).water.noise_level_db = 35.0;
  world_of(config).seabed.sediments[0] = seabed::Lambert{-25.0};
  return config;
}

/// What the beams of each sector receive of a ping, as of the first three stages.
inline std::span<const SectorBeams> receive_echoes(const Multibeam& head, const PingEvent& event,
                                                   const HeadSettings& settings, const Steering& steering,
                                                   const frames::PoseHistory& truth, const trace::Scene& seabed,
                                                   Multibeam::Memory& memory) {
  const Multibeam::Design& design = design_of(head, settings, memory.design);
  const auto sent = head.insonify(event, settings, design, steering, around(truth, seabed), memory);
  return head.beamform(event, settings, steering, sent, head.echoes(sent, memory), memory);
}

}  // namespace ensonify
