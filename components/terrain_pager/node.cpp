#include "components/terrain_pager/node.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "components/config/config_error.h"
#include "components/config/data_paths.h"
#include "components/errors/exit_error.h"
#include "components/runtime/declared.h"
#include "components/runtime/log.h"
#include "components/terrain/source_of.h"
#include "components/terrain_pager/mission_track.h"
#include "components/terrain_pager/paging.h"
#include "components/terrain_pager/seabed_identity.h"

namespace ensonify {
namespace {

using frames::Vec2;
using pager::TileKey;

constexpr std::size_t kTileBytes = 1025 * 1025 * 5 + 256 * sizeof(double) + 4096;
constexpr std::size_t kChartBytes = 256 * 256 * 4 + 4096;
constexpr double kTurnSmoothing_s = 5.0;  // waves turn a vehicle to and fro in less

pager::Box box_of(const source::Extent& extent) {
  return {{extent.west_m, extent.south_m}, {extent.east_m, extent.north_m}};
}

/// The first update publishes all that is near, which a declared rate must leave room for.
Rate all_at_once(std::size_t messages) {
  return {std::clamp<std::int64_t>(static_cast<std::int64_t>(messages), 10, 10'000), 1};
}

}  // namespace

msg::Tile pager::make_tile(const source::TerrainSource& terrain, const terrain::TileGrid& grid,
                           const terrain::TileKey& key) {
  const auto side = static_cast<std::size_t>(grid.cells) + 1;
  const Vec2 origin = grid.origin_of(key);
  msg::Tile tile;
  tile.col = key.east;
  tile.row = key.north;
  tile.origin_east_m = origin.x();
  tile.origin_north_m = origin.y();
  tile.spacing_m = grid.spacing_m;
  tile.height_m = msg::Array<float>({side, side});
  tile.sediment = msg::Array<std::uint8_t>({side, side});
  source::fill_tile(terrain, grid, key, tile.height_m.flat(), tile.sediment.flat());
  return tile;
}

msg::Chart pager::make_chart(const source::TerrainSource& terrain, const source::Overview& overview) {
  const source::PostBlock& block = overview.posts;
  msg::Chart chart;
  chart.origin_latitude_deg = terrain.origin().latitude_deg;
  chart.origin_longitude_deg = terrain.origin().longitude_deg;
  chart.west_m = block.east_m(0);
  chart.south_m = block.north_m(0);
  chart.east_m = block.east_m(block.columns - 1);
  chart.north_m = block.north_m(block.rows - 1);
  chart.shallowest_m = -terrain.highest_m();
  chart.deepest_m = -terrain.lowest_m();
  chart.spacing_m = block.spacing_m;
  chart.height_m = msg::Array<float>({static_cast<std::size_t>(block.rows), static_cast<std::size_t>(block.columns)});
  std::ranges::copy(overview.height_m, chart.height_m.flat().begin());
  return chart;
}

std::size_t TerrainPagerNode::most_tiles() const { return pager::most_in_memory(config_, grid_); }

TerrainPagerNode::TerrainPagerNode(const Config& config, Ports& ports)
    : config_(config),
      ports_(ports),
      events_(Rate{config.rate_hz, 1}),
      resident_(pager::take_resident(pager::resident_identity(config))),
      terrain_(resident_.terrain ? resident_.terrain : source::source_of(config.terrain)),
      grid_{Vec2::Zero(), source::post_spacing_m(config.terrain, *terrain_), 1024,
            source::lsb_m(config.terrain, *terrain_)},
      box_(box_of(terrain_->extent())),
      meshes_(config, *terrain_, resident_.meshes),
      objects_(config, *terrain_),
      tiles_(ports.out<msg::Tile>("tile", {.max_bytes = kTileBytes, .rate = all_at_once(most_tiles())})),
      releases_(ports.out<msg::TileRelease>("release", {.rate = all_at_once(most_tiles())})),
      meshes_out_(
          ports.out<msg::Mesh>("mesh", {.max_bytes = meshes_.max_bytes(), .rate = all_at_once(meshes_.count())})),
      mesh_releases_(ports.out<msg::MeshRelease>("mesh_release", {.rate = all_at_once(meshes_.count())})),
      object_meshes_(ports.out<msg::ObjectMesh>(
          "object_mesh", {.max_bytes = objects_.max_bytes(), .rate = all_at_once(objects_.mesh_count())})),
      objects_out_(ports.out<msg::Object>("object", {.rate = all_at_once(objects_.count())})),
      object_releases_(ports.out<msg::ObjectRelease>("object_release", {.rate = all_at_once(objects_.count())})),
      chart_(ports.out<msg::Chart>("chart", {.max_bytes = kChartBytes})),
      chart_view_(ports.live_out<msg::Chart>("chart_view", kChartBytes)),
      paging_port_(ports.declare_out({"paging", msg::Health::kType, 4096, Rate{config.rate_hz, 1}})) {
  const double feed_m =
      config.feed_margin_m > 0.0 ? config.feed_margin_m : pager::demanded_m({}, -terrain_->lowest_m());
  if (config.feed_margin_m > 0.0) pager::check_budgets(config, rules(feed_m).margins, grid_, box_);
  // Tiles and chart come while the mission is checked and other processes start.
  open_cache();
  store_.emplace([this](const TileKey& key) { return made(key); },
                 pager::TileStore::Limits{config.threads, most_tiles()}, std::exchange(resident_.tiles, {}));
  if (const auto start = pager::first_place(config)) {
    const pager::Paging probably(grid_, box_, rules(feed_m));
    store_->hold(probably.before_start(*start));
  }
  if (!resident_.glance) made_glance_ = std::async(std::launch::async, [this] { return glance(); });
  const double shallowest_m = pager::check_mission(*terrain_, config, pager::Beyond::kRefused);
  ports.declare(msg::PagerDeclaration{grid_.spacing_m, shallowest_m});
  ports.in<msg::Pose>("pose", [this](const msg::Pose& pose) { pose_ = pose; });
}

TerrainPagerNode::~TerrainPagerNode() {
  resident_.terrain = terrain_;
  if (store_) resident_.tiles = store_->ready();
  pager::leave_resident(std::move(resident_));
}

SimTime TerrainPagerNode::step(SimTime now) {
  if (!events_.due(now)) return events_.next();
  if (!started_) start();
  if (pose_) page(*pose_);
  report_cache();
  show_chart();
  return events_.next();
}

/// The chart went out once, at the start. Who begins to watch later gets it here.
void TerrainPagerNode::show_chart() {
  const bool watched = chart_view_.watched();
  if (watched && !chart_shown_) chart_view_.send(resident_.glance->chart);
  chart_shown_ = watched;
}

/// Tiles of files are on disk already. Without a launch nothing says which seabed it is.
void TerrainPagerNode::open_cache() {
  const bool generated = config_.terrain.seabed.kind == Seabed::Kind::kLayers;
  if (config_.cache_mb <= 0.0 || !generated || config_.scenario_text.empty()) return;
  const std::string folder = config_.cache_folder.empty() ? tile_cache_folder() : config_.cache_folder;
  if (folder.empty()) {
    log::event(ports_, "tile_cache_failed", "why=\"no folder: set XDG_CACHE_HOME, HOME or cache_folder\"");
    return;
  }
  cache_.emplace(folder, pager::seabed_identity(config_), static_cast<std::uint64_t>(1e6 * config_.cache_mb));
}

/// Called by the store's threads.
pager::TileStore::TilePtr TerrainPagerNode::made(const TileKey& key) {
  if (cache_) {
    if (auto kept = cache_->read(key)) return kept;
  }
  auto tile = std::make_shared<const msg::Tile>(pager::make_tile(*terrain_, grid_, key));
  if (cache_) cache_->write(*tile);
  return tile;
}

pager::Glance TerrainPagerNode::glance() {
  auto relief = terrain_->meshed_relief();
  pager::Glance glance;
  glance.uneven = std::move(relief.uneven);
  glance.facet_mean_square_slope = msg::Array<double>::of(std::move(relief.mean_square_slope));
  if (cache_) {
    if (const auto kept = cache_->read_chart()) {
      glance.chart = *kept;
      return glance;
    }
  }
  const source::Overview overview = terrain_->overview();
  glance.fault = overview.fault;
  glance.chart = pager::make_chart(*terrain_, overview);
  if (cache_) cache_->write(glance.chart);
  return glance;
}

void TerrainPagerNode::start() {
  started_ = true;
  if (made_glance_.valid()) resident_.glance = made_glance_.get();
  chart_.send(resident_.glance->chart);
  if (!resident_.glance->fault.empty()) log::event(ports_, "overview_unusable", "why=\"{}\"", resident_.glance->fault);
  for (const auto& uneven : resident_.glance->uneven)
    log::event(ports_, "uneven_class", "class={} layer={} off_db={:.1f} why=\"{}\"", uneven.seabed_class, uneven.layer,
               uneven.off_db, text_of(uneven));
  for (const std::string& name : meshes_.unprepared())
    log::event(ports_, "mesh_unprepared", "mesh={} prepare_with=\"ensonify terrain lod\"", name);
}

pager::Paging::Rules TerrainPagerNode::rules(double feed_margin_m) const {
  pager::Paging::Rules rules;
  rules.margins = {feed_margin_m, feed_margin_m + config_.release_hysteresis_m};
  rules.horizon = {config_.load_ahead_s, 1.0 / config_.rate_hz, feed_margin_m, feed_margin_m + config_.wide_margin_m};
  rules.most = most_tiles();
  return rules;
}

/// What heads declare is known when time starts. Between two updates the vehicle moves on.
void TerrainPagerNode::start_paging() {
  double feed_m = config_.feed_margin_m;
  if (feed_m <= 0.0) {
    feed_m = pager::demanded_m(declared<msg::HeadDeclaration>(ports_.facts()), -terrain_->lowest_m()) +
             config_.fastest_mps / config_.rate_hz;
    try {
      pager::check_budgets(config_, rules(feed_m).margins, grid_, box_);
    } catch (const ConfigError& error) {
      throw UserError(error.what());
    }
  }
  margins_ = rules(feed_m).margins;
  paging_.emplace(grid_, box_, rules(feed_m));
}

paging::Motion TerrainPagerNode::motion_of(const msg::Pose& pose) {
  const double share = 1.0 - std::exp(-1.0 / (config_.rate_hz * kTurnSmoothing_s));
  turn_rate_radps_ += share * (-pose.rate_body_radps[2] - turn_rate_radps_);  // a body's z axis points down
  return {{pose.position_enu_m[0], pose.position_enu_m[1]},
          {pose.velocity_enu_mps[0], pose.velocity_enu_mps[1]},
          turn_rate_radps_};
}

void TerrainPagerNode::page(const msg::Pose& pose) {
  if (!paging_) {
    start_paging();
    for (const std::string& said : objects_.said()) log::event(ports_, "object_mesh", "{}", said);
  }
  const paging::Motion motion = motion_of(pose);
  const auto decision = paging_->update(motion);
  store_->hold(decision.in_memory);
  for (const TileKey& key : decision.publish) publish(key);
  for (const TileKey& key : decision.release) {
    releases_.send({key.east, key.north});
    ports_.count("tiles_released");
  }
  exchange_meshes(motion.position_enu_m);
  exchange_objects(motion.position_enu_m);
  report_paging(decision);
  const bool inside = terrain_->extent().contains(motion.position_enu_m);
  ports_.health(inside ? "ok" : "degraded", inside ? "" : "the vehicle is outside the terrain");
}

void TerrainPagerNode::publish(const TileKey& key) {
  const auto taken = store_->take(key);
  if (taken.late) {
    log::event(ports_, "late_tile", "col={} row={} late_tiles={}", key.east, key.north, store_->statistics().late);
  }
  msg::Tile tile = *taken.tile;  // shares its posts
  tile.facet_mean_square_slope = resident_.glance->facet_mean_square_slope;
  tiles_.send(tile);
  ports_.count("tiles_published");
}

void TerrainPagerNode::report_cache() {
  if (!cache_) return;
  for (const auto& notice : cache_->take_notices()) log::event(ports_, notice.event, "{}", notice.pairs);
}

void TerrainPagerNode::exchange_meshes(const Vec2& place_enu_m) {
  const auto decision = meshes_.update(place_enu_m, margins_);
  for (const msg::Mesh* mesh : decision.publish) {
    meshes_out_.send(*mesh);
    ports_.count("meshes_published");
  }
  for (const std::int64_t number : decision.release) {
    mesh_releases_.send({number});
    ports_.count("meshes_released");
  }
}

void TerrainPagerNode::exchange_objects(const Vec2& place_enu_m) {
  const auto decision = objects_.update(place_enu_m, margins_);
  for (const msg::ObjectMesh* mesh : decision.meshes) object_meshes_.send(*mesh);
  for (const msg::Object* object : decision.publish) {
    objects_out_.send(*object);
    ports_.count("objects_published");
  }
  for (const std::int64_t number : decision.release) {
    object_releases_.send({number});
    ports_.count("objects_released");
  }
}

/// A message only when poses have changed something; what disk and threads did goes behind it, for viewers.
void TerrainPagerNode::report_paging(const pager::Paging::Decision& decision) {
  fetched_ += decision.fetched;
  fetched_again_ += decision.fetched_again;
  if (decision.publish.empty() && decision.release.empty() && decision.fetched == 0) return;
  msg::Health paging;
  paging.stamp_ns = ports_.now().count();
  paging.message = fmt::format("{} tiles are meant to be in memory", decision.in_memory.size());
  paging.counters = {{"tiles_fetched", fetched_}, {"tiles_fetched_again", fetched_again_}};

  const auto statistics = store_->statistics();
  const double tile_mb = 1e-6 * static_cast<double>(pager::tile_bytes(grid_));
  std::string wall =
      fmt::format(R"({{"resident_tiles":{},"resident_mb":{:.1f},"most_resident_mb":{:.1f},"tiles_made":{})",
                  statistics.resident, tile_mb * static_cast<double>(statistics.resident),
                  tile_mb * static_cast<double>(statistics.most_resident), statistics.made);
  if (cache_) wall += fmt::format(R"(,"tiles_from_cache":{})", cache_->statistics().read);
  if (statistics.taken > 0) {
    const auto taken = static_cast<double>(statistics.taken), late = static_cast<double>(statistics.late);
    wall += fmt::format(R"(,"hit_rate":{:.4f},"late_tiles":{},"least_margin_s":{:.3f})", (taken - late) / taken,
                        statistics.late, statistics.least_margin_s);
  }
  ports_.publish(paging_port_, msg::encode(paging), msg::Buffer::own(wall + "}"));
}

}  // namespace ensonify
