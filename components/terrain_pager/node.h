#pragma once

#include <future>
#include <memory>
#include <optional>

#include "components/runtime/ports.h"
#include "components/terrain_pager/config.h"
#include "components/terrain_pager/meshes.h"
#include "components/terrain_pager/objects.h"
#include "components/terrain_pager/paging.h"
#include "components/terrain_pager/resident.h"
#include "components/terrain_pager/tile_cache.h"
#include "components/terrain_pager/tile_store.h"
#include "messages/motion.h"
#include "messages/terrain.h"

namespace ensonify {

namespace pager {

/// A tile of the set, its heights on the lattice.
msg::Tile make_tile(const source::TerrainSource& terrain, const terrain::TileGrid& grid, const terrain::TileKey& key);

/// The terrain at a glance: its overview, at most 256 x 256 posts.
msg::Chart make_chart(const source::TerrainSource& terrain, const source::Overview& overview);

}  // namespace pager

/// Gives heads the seabed around the vehicle, tile by tile, and planners a chart of the whole.
class TerrainPagerNode {
 public:
  using Config = TerrainPagerConfig;
  static constexpr const char* kComponent = "terrain_pager";

  TerrainPagerNode(const Config& config, Ports& ports);
  /// What it has made of the seabed stays for the next of this process.
  ~TerrainPagerNode();
  TerrainPagerNode(const TerrainPagerNode&) = delete;
  TerrainPagerNode& operator=(const TerrainPagerNode&) = delete;

  SimTime step(SimTime now);

  /// A wall-clock fact: how fast disk and threads are, never what is sent.
  pager::TileStore::Statistics statistics() const { return store_->statistics(); }
  /// The same of what was kept on disk; zeros without a cache.
  pager::TileCache::Statistics cached() const { return cache_ ? cache_->statistics() : pager::TileCache::Statistics{}; }

 private:
  std::size_t most_tiles() const;
  pager::Paging::Rules rules(double feed_margin_m) const;
  void open_cache();
  pager::TileStore::TilePtr made(const pager::TileKey& key);
  pager::Glance glance();
  void start();
  void start_paging();
  paging::Motion motion_of(const msg::Pose& pose);
  void page(const msg::Pose& pose);
  void publish(const pager::TileKey& key);
  void report_cache();
  void show_chart();
  void exchange_meshes(const source::Vec2& place_enu_m);
  void exchange_objects(const source::Vec2& place_enu_m);
  void report_paging(const pager::Paging::Decision& decision);

  Config config_;
  Ports& ports_;
  Periodic events_;
  pager::Resident resident_;
  std::shared_ptr<const source::TerrainSource> terrain_;
  pager::TileGrid grid_;
  pager::Box box_;
  pager::Meshes meshes_;
  pager::Objects objects_;
  std::optional<pager::Paging> paging_;  // from the first update on, when it is known how far heads receive
  paging::Margins margins_;              // the same
  std::optional<pager::TileCache> cache_;
  std::optional<pager::TileStore> store_;  // its threads use what stands above
  double turn_rate_radps_ = 0.0;           // of the vehicle, smoothed
  std::optional<msg::Pose> pose_;
  Ports::Out<msg::Tile> tiles_;
  Ports::Out<msg::TileRelease> releases_;
  Ports::Out<msg::Mesh> meshes_out_;
  Ports::Out<msg::MeshRelease> mesh_releases_;
  Ports::Out<msg::ObjectMesh> object_meshes_;
  Ports::Out<msg::Object> objects_out_;
  Ports::Out<msg::ObjectRelease> object_releases_;
  Ports::Out<msg::Chart> chart_;
  Ports::LiveOut<msg::Chart> chart_view_;
  bool chart_shown_ = false;  // to those who watch now
  std::size_t paging_port_;
  std::int64_t fetched_ = 0, fetched_again_ = 0;
  bool started_ = false;
  std::future<pager::Glance> made_glance_;  // while other processes start; until it is sent
};

}  // namespace ensonify
