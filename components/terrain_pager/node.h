#pragma once

#include <memory>
#include <optional>

#include "components/runtime/ports.h"
#include "components/terrain_pager/config.h"
#include "components/terrain_pager/paging.h"
#include "components/terrain_pager/tile_store.h"
#include "messages/motion.h"
#include "messages/terrain.h"

namespace ensonify {

/// Gives heads the seabed around the vehicle, tile by tile, and planners a chart of the whole.
class TerrainPagerNode {
 public:
  using Config = TerrainPagerConfig;
  static constexpr const char* kComponent = "terrain_pager";

  TerrainPagerNode(const Config& config, Ports& ports);

  SimTime step(SimTime now);

  /// Tiles that were due before they were in memory. A wall-clock fact: it says how fast the disk is, never what is
  /// sent.
  int late_tiles() const { return late_tiles_; }

 private:
  void page(const msg::Pose& pose);
  void publish(const pager::TileKey& key);

  Ports& ports_;
  Periodic events_;
  std::unique_ptr<source::TerrainSource> terrain_;
  pager::TileGrid grid_;
  double load_ahead_s_;
  std::unique_ptr<pager::Paging> paging_;
  std::unique_ptr<pager::TileStore> store_;
  std::optional<msg::Pose> pose_;
  Ports::Out<msg::Tile> tiles_;
  Ports::Out<msg::TileRelease> releases_;
  Ports::Out<msg::Chart> chart_;
  bool chart_sent_ = false;
  int late_tiles_ = 0;
};

}  // namespace ensonify
