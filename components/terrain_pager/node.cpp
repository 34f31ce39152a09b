#include "components/terrain_pager/node.h"

#include <algorithm>

#include "components/runtime/config/config_error.h"
#include "components/runtime/log.h"
#include "components/runtime/terrain/source_of.h"
#include "components/terrain_pager/corridor.h"
#include "components/terrain_pager/tile_messages.h"

namespace ensonify {
namespace {

using pager::Margins;
using pager::TileKey;
using pager::Vec2;

constexpr std::size_t kTileBytes = 1025 * 1025 * 5 + 4096;
constexpr std::size_t kChartBytes = 256 * 256 * 4 + 4096;
constexpr std::size_t kMostTilesHeld = 64;  // each is 5 MB in every head
constexpr double kPi = 3.14159265358979323846;

Margins margins_of(const TerrainPagerConfig& config, const pager::TerrainSource& terrain) {
  Margins margins;
  margins.feed_m = config.feed_margin_m > 0.0 ? config.feed_margin_m : 3.0 * -terrain.lowest_m() + 20.0;
  margins.release_m = margins.feed_m + config.release_hysteresis_m;
  margins.load_m = margins.release_m + config.load_ahead_s * config.mission.speed_mps;
  return margins;
}

/// Heads could not hold the tiles that such margins and posts ask for: said before the run, not by the kernel's OOM
/// killer.
void check_memory(const TerrainPagerConfig& config, const pager::Margins& margins, const pager::TileGrid& grid) {
  const double across = 2.0 * margins.release_m / grid.side_m() + 1.0;
  const double terrain_tiles = across * across;
  if (terrain_tiles > static_cast<double>(kMostTilesHeld)) {
    throw ConfigError(
        {ConfigProblem{{config.scenario_file, 0, 0},
                       "seabed.post_spacing_m",
                       "posts " + std::to_string(grid.spacing_m) + " m apart make about " +
                           std::to_string(static_cast<long>(terrain_tiles)) + " tiles within " +
                           std::to_string(margins.release_m) + " m of the vehicle; at most " +
                           std::to_string(kMostTilesHeld) + " are allowed: widen the posts or narrow feed_margin_m"}});
  }
}

}  // namespace

TerrainPagerNode::TerrainPagerNode(const Config& config, Ports& ports)
    : ports_(ports),
      events_(Rate{config.rate_hz, 1}),
      terrain_(source::source_of(config.terrain)),
      grid_{Vec2::Zero(), source::post_spacing_m(config.terrain, *terrain_), 1024,
            source::lsb_m(config.terrain, *terrain_)},
      load_ahead_s_(config.load_ahead_s),
      tiles_(ports.out<msg::Tile>("tile", {.max_bytes = kTileBytes})),
      releases_(ports.out<msg::TileRelease>("release")),
      chart_(ports.out<msg::Chart>("chart", {.max_bytes = kChartBytes})) {
  const auto holes = config.terrain.seabed.kind == Seabed::Kind::kRaster ? config.terrain.seabed.raster.holes
                                                                         : RasterSeabed::Holes::kKeep;
  pager::check_corridors(*terrain_, config.mission.runlines,
                         {config.corridor_half_deg * kPi / 180.0, holes == RasterSeabed::Holes::kRefuse},
                         config.scenario_file);
  ports.note("post_spacing_m", grid_.spacing_m);
  ports.note("shallowest_m", pager::shallowest_m(*terrain_, config.mission.runlines));
  const Margins margins = margins_of(config, *terrain_);
  const auto extent = terrain_->extent();
  if (std::max(extent.east_m - extent.west_m, extent.north_m - extent.south_m) > 2.0 * margins.release_m) {
    check_memory(config, margins, grid_);
  }
  paging_ = std::make_unique<pager::Paging>(grid_, extent, margins);
  store_ = std::make_unique<pager::TileStore>(
      [this](const TileKey& key) { return std::make_shared<const msg::Tile>(pager::make_tile(*terrain_, grid_, key)); },
      config.threads);
  if (!config.mission.runlines.empty()) {
    store_->want(paging_->within(config.mission.runlines.front().start_enu_m, margins.load_m));
  }
  ports.in<msg::Pose>("pose", [this](const msg::Pose& pose) { pose_ = pose; });
}

SimTime TerrainPagerNode::step(SimTime now) {
  if (!events_.due(now)) return events_.next();
  if (!chart_sent_) chart_.send(pager::make_chart(*terrain_));
  chart_sent_ = true;
  if (pose_) page(*pose_);
  return events_.next();
}

void TerrainPagerNode::page(const msg::Pose& pose) {
  const Vec2 position(pose.position_enu_m[0], pose.position_enu_m[1]);
  const Vec2 velocity(pose.velocity_enu_mps[0], pose.velocity_enu_mps[1]);
  const auto decision = paging_->decide(position, position + 0.5 * load_ahead_s_ * velocity);
  store_->want(decision.keep_in_memory);
  for (const TileKey& key : decision.publish) publish(key);
  for (const TileKey& key : decision.release) {
    releases_.send({key.east, key.north});
    ports_.count("tiles_released");
  }
  const bool inside = terrain_->extent().contains(position);
  ports_.health(inside ? "ok" : "degraded", inside ? "" : "the vehicle is outside the terrain");
}

void TerrainPagerNode::publish(const TileKey& key) {
  const auto taken = store_->take(key);
  if (taken.late) {
    ++late_tiles_;
    log::event(ports_, "late_tile", "col={} row={} late_tiles={}", key.east, key.north, late_tiles_);
  }
  tiles_.send(*taken.tile);
  ports_.count("tiles_published");
}

}  // namespace ensonify
