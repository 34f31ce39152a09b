#pragma once

#include <optional>

#include "components/runtime/ports.h"
#include "components/sonar/tile_set.h"
#include "kernels/base/frames/pose.h"

namespace ensonify {

/// The true seabed, as instruments with narrow beams sample it.
class SeabedBelow {
 public:
  /// `optional`: the ports `tile` and `release` may stay unconnected, and then there is no seabed. `mesh` and
  /// `mesh_release` always may.
  void connect(Ports& ports, bool optional);

  /// From `from` along a direction of its frame; empty where nothing is as near as `longest_m`. A function of these and
  /// of the tiles.
  std::optional<double> distance_m(const frames::HeadPose& from, const frames::Vec3& direction, double longest_m);

 private:
  TileSet tiles_{
      trace::LevelOfDetail{.enabled = true, .adaptations_per_ping = 8}};  // fine along the beams of a measurement alone
};

}  // namespace ensonify
