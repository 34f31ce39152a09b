#include "components/terrain_pager/node.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <thread>

#include "components/config/config_error.h"
#include "components/config/config_reader.h"
#include "components/runtime/testing/node_under_test.h"

using namespace ensonify;
using Catch::WithinAbs;

namespace {

/// 800 m x 800 m of slope with tiles of 102.4 m.
TerrainPagerConfig small_slope() {
  TerrainPagerConfig config;
  config.terrain.seabed.post_spacing_m = 0.1;
  config.terrain.seabed.layered.layers = {
      {.name = "slope", .form = relief::Plane{.depth_m = 15.0, .slope = std::tan(0.01)}}};
  config.terrain.seabed.layered.size_m = {800.0, 800.0};
  config.feed_margin_m = 60.0;
  config.release_hysteresis_m = 20.0;
  return config;
}

/// A folder that goes with its owner.
struct Folder {
  std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("ensonify-pager-" + std::to_string(::getpid()));
  ~Folder() { std::filesystem::remove_all(path); }
};

msg::Pose pose_at(SimTime t, double east_m, double north_m) {
  msg::Pose pose;
  pose.stamp_ns = t.count();
  pose.position_enu_m = {east_m, north_m, 0.0};
  pose.velocity_enu_mps = {4.0, 0.0, 0.0};
  return pose;
}

}  // namespace

TEST_CASE("a viewer who comes late gets the chart, once") {
  NodeUnderTest<TerrainPagerNode> pager(small_slope());
  const auto first = pager.step_until<msg::Chart>("chart", 5_s);
  REQUIRE(first.size() == 1);
  CHECK(pager.take("chart_view").empty());
  pager.watch();
  const auto charts = pager.step_until<msg::Chart>("chart_view", 10_s);
  REQUIRE(charts.size() == 1);
  CHECK(charts[0].height_m == first[0].height_m);
  CHECK(pager.take("chart").empty());
}

TEST_CASE("the chart goes out once, at the start") {
  NodeUnderTest<TerrainPagerNode> pager(small_slope());
  const auto charts = pager.step_until<msg::Chart>("chart", 5_s);
  REQUIRE(charts.size() == 1);
  CHECK_THAT(charts[0].deepest_m, WithinAbs(15.0 + 400 * 0.01, 0.1));
  CHECK(charts[0].height_m.rows() <= 256);
}

TEST_CASE("the tiles around the vehicle go out in the first event, each once") {
  NodeUnderTest<TerrainPagerNode> pager(small_slope());
  pager.give("pose", pose_at(0_s, 50, 50), pose_at(1_s, 51, 50));
  const auto tiles = pager.step_until<msg::Tile>("tile", 2_s);
  REQUIRE(tiles.size() == 5);  // its own and the four beside it; the corners are farther than 60 m
  CHECK(tiles[0].col == 0);
  CHECK(tiles[0].row == 0);
  CHECK(tiles[0].height_m.rows() == 1025);
  CHECK_THAT(tiles[0].height_m(0, 0), WithinAbs(-15.0, 1e-4));
  CHECK_THAT(tiles[0].height_m(1024, 0), WithinAbs(-15.0 - 102.4 * std::tan(0.01), 2e-4));
}

TEST_CASE("a vehicle under way gets tiles ahead and gives up those behind") {
  NodeUnderTest<TerrainPagerNode> pager(small_slope());
  for (int s = 0; s <= 50; ++s) pager.give("pose", pose_at(std::chrono::seconds(s), -300.0 + 4.0 * s, 0.0));
  std::set<std::pair<std::int64_t, std::int64_t>> held;
  for (const auto& tile : pager.step_until<msg::Tile>("tile", 50_s)) CHECK(held.emplace(tile.col, tile.row).second);
  const auto releases = pager.step_until<msg::TileRelease>("release", 50_s);
  CHECK(releases.size() >= 2);
  for (const auto& release : releases) CHECK(held.erase({release.col, release.row}) == 1);
  CHECK(held.contains({-1, 0}));  // under the vehicle, at (-100, 0)
  CHECK(held.contains({-1, -1}));
  CHECK_FALSE(held.contains({-3, 0}));  // its eastern edge is 104 m behind
}

TEST_CASE("published tiles depend neither on the number of threads nor on the budget") {
  const auto published = [](int threads, double budget_mb) {
    auto config = small_slope();
    config.threads = threads;
    config.budget_mb = budget_mb;
    NodeUnderTest<TerrainPagerNode> pager(config);
    for (int s = 0; s <= 20; ++s) pager.give("pose", pose_at(std::chrono::seconds(s), -300.0 + 10.0 * s, 0.0));
    return pager.step_until<msg::Tile>("tile", 20_s);
  };
  const auto one = published(1, 512.0);
  // 6 tiles may lie within 60 m, and one is being made: 7 x 5.25 MB, the least that is allowed.
  const auto four = GENERATE_COPY(published(4, 512.0), published(1, 37.0));
  REQUIRE(one.size() == four.size());
  REQUIRE(one.size() > 4);
  for (std::size_t i = 0; i < one.size(); ++i) {
    CHECK(one[i].col == four[i].col);
    CHECK(one[i].row == four[i].row);
    CHECK(one[i].sediment == four[i].sediment);
    CHECK(msg::same_bytes(one[i].height_m.buffer(), four[i].height_m.buffer()));  // NaN equals NaN here
  }
}

TEST_CASE("a second run takes its tiles from the cache, bit-equal to those made") {
  const Folder folder;
  auto config = small_slope();
  config.load_ahead_s = 1.0;
  config.wide_margin_m = 0.0;
  config.terrain.seabed.layered.layers.push_back(
      {.name = "rock", .form = layers::Spectral{.spectrum = {.rms_m = 0.3, .outer_scale_m = 50.0}}});
  struct Outcome {
    std::vector<msg::Tile> tiles;
    pager::TileCache::Statistics cached;
    std::int64_t made = 0;  // or fetched from the cache
  };
  const auto run = [&] {
    pager::take_resident("");  // as in another process
    NodeUnderTest<TerrainPagerNode> pager(config);
    pager.give("pose", pose_at(0_s, 50, 50), pose_at(1_s, 54, 50));
    Outcome outcome;
    outcome.tiles = pager.step_until<msg::Tile>("tile", 1_s);
    // All that is meant to be in memory, also ahead of need: then the next run finds all of it.
    const auto reported = pager.step_until<msg::Health>("paging", 1_s);
    while (pager.node().statistics().made < std::stoi(reported.back().message)) std::this_thread::yield();
    outcome.made = pager.node().statistics().made;
    outcome.cached = pager.node().cached();
    return outcome;
  };
  const auto expect_same = [](const Outcome& a, const Outcome& b) {
    REQUIRE(a.tiles.size() == b.tiles.size());
    for (std::size_t i = 0; i < a.tiles.size(); ++i) {
      CHECK(a.tiles[i].col == b.tiles[i].col);
      CHECK(a.tiles[i].row == b.tiles[i].row);
      CHECK(a.tiles[i].sediment == b.tiles[i].sediment);
      CHECK(msg::same_bytes(a.tiles[i].height_m.buffer(), b.tiles[i].height_m.buffer()));
    }
  };
  const Outcome without = run();
  CHECK(without.cached.written == 0);
  REQUIRE(without.tiles.size() == 5);

  config.cache_folder = folder.path.string();
  config.cache_mb = 500.0;
  config.scenario_text = "seed: 0\n";
  const Outcome cold = run();
  CHECK(cold.cached.written == cold.made);
  CHECK(cold.cached.read == 0);
  expect_same(cold, without);
  const Outcome warm = run();
  CHECK(warm.cached.read == warm.made);
  CHECK(warm.cached.written == 0);
  expect_same(warm, without);

  SECTION("another seed is another seabed") {
    config.scenario_text = "seed: 7\n";
    config.terrain.seabed.layered.seed = 7;
    const Outcome other = run();
    CHECK(other.cached.read == 0);
    CHECK_FALSE(msg::same_bytes(other.tiles[0].height_m.buffer(), without.tiles[0].height_m.buffer()));
    expect_same(run(), other);
  }
  SECTION("a damaged tile is made anew") {
    for (const auto& entry : std::filesystem::directory_iterator(folder.path)) {
      std::fstream(entry.path(), std::ios::in | std::ios::out | std::ios::binary)
          .seekp(2'000'000)
          .put('\x55')
          .put('\xAA');
    }
    const Outcome mended = run();
    CHECK(mended.cached.read == 0);
    CHECK(mended.cached.written == mended.made);
    expect_same(mended, without);
  }
}

TEST_CASE("outside the terrain nothing is published and health says so") {
  NodeUnderTest<TerrainPagerNode> pager(small_slope());
  pager.give("pose", pose_at(0_s, 900, 0));
  CHECK(pager.step_until<msg::Tile>("tile", 1_s).empty());
  const auto health = pager.step_until<msg::Health>("health", 1_s);
  REQUIRE_FALSE(health.empty());
  CHECK(health.back().state == "degraded");
  CHECK(health.back().message == "the vehicle is outside the terrain");
}

TEST_CASE("posts too fine for the depth are refused before the run") {
  auto config = small_slope();
  config.terrain.seabed.post_spacing_m = 0.01;
  CHECK_THROWS_WITH(
      NodeUnderTest<TerrainPagerNode>(config),
      Catch::Contains("seabed.post_spacing_m: posts 0.01 m apart make up to") && Catch::Contains("at most 336 MB"));
}

TEST_CASE("a budget too small for what heads need at once is refused, with its place") {
  auto from = ConfigReader::from_text("feed_margin_m: 60\nbudget_mb: 30\n", "pager.yaml");
  World world;
  world.seabed = small_slope().terrain.seabed;
  const auto config = TerrainPagerConfig::read(from, world, "pager");
  CHECK_THROWS_WITH(
      NodeUnderTest<TerrainPagerNode>(config),
      "pager.yaml:1:1: budget_mb: 30 does not hold the 6 tiles that may lie within 60 m of the vehicle and 2 "
      "being made; at least 43 are needed");
}

TEST_CASE("memory keeps its budget, counted in bytes, however fast the vehicle") {
  auto config = small_slope();
  config.threads = 2;
  config.budget_mb = 43.0;  // 8 tiles: 6 at once and 2 being made
  NodeUnderTest<TerrainPagerNode> pager(config);
  for (int s = 0; s <= 20; ++s) pager.give("pose", pose_at(std::chrono::seconds(s), -300.0 + 30.0 * s, 0.0));
  CHECK(pager.step_until<msg::Tile>("tile", 20_s).size() > 10);
  CHECK(static_cast<double>(pager.node().statistics().most_resident) * 1025 * 1025 * 5 <= 43e6);
}

TEST_CASE("fetched tiles are counted, with the speed of disk and threads") {
  NodeUnderTest<TerrainPagerNode> pager(small_slope());
  for (int s = 0; s <= 20; ++s) pager.give("pose", pose_at(std::chrono::seconds(s), -300.0 + 4.0 * s, 0.0));
  pager.run_until(20_s);
  const auto packets = pager.take("paging");
  REQUIRE_FALSE(packets.empty());
  const auto health = msg::decode<msg::Health>(packets.back().body, packets.back().body.size());
  std::map<std::string, std::int64_t> counters;
  for (const auto& counter : health.counters) counters[counter.name] = counter.count;
  CHECK(counters.at("tiles_fetched") >= static_cast<std::int64_t>(pager.take("tile").size()));
  CHECK(counters.at("tiles_fetched_again") == 0);
  const std::string wall(packets.back().wall_facts.text());
  for (const char* name : {"resident_tiles", "resident_mb", "tiles_made", "hit_rate", "late_tiles", "least_margin_s"}) {
    CHECK_THAT(wall, Catch::Contains("\"" + std::string(name) + "\":"));
  }
}

TEST_CASE("a runline outside the terrain is refused") {
  auto config = small_slope();
  config.scenario_file = "bay.yaml";
  config.mission.steps = steps_of({{{0, 0}, {100, 0}}, {{0, 0}, {500, 0}}});
  config.mission.run_in_m = 0.0;
  CHECK_THROWS_WITH(
      NodeUnderTest<TerrainPagerNode>(config),
      "bay.yaml: mission runline 2: its end (500.0, 0.0) m is outside the terrain; allowed is east -400.0 "
      "to 400.0 m and north -400.0 to 400.0 m");
}

namespace {

/// A seabed of hills, as a launch has it.
TerrainPagerConfig hills(std::uint64_t seed) {
  TerrainPagerConfig config = small_slope();
  config.terrain.seabed.layered.seed = seed;
  config.terrain.seabed.layered.layers = {
      {.name = "hills",
       .form =
           layers::Spectral{.spectrum = {.rms_m = 1.0, .outer_scale_m = 50.0, .inner_scale_m = 5.0}, .mean_m = -15.0}}};
  const progressive::Bar bar{.from_m = {20.0, 20.0, -10.0}, .to_m = {30.0, 20.0, -10.0}, .diameter_m = 0.5};
  SeabedMesh mesh;
  mesh.name = "bar";
  mesh.bars = {bar};
  config.terrain.seabed.meshes = {mesh};
  config.scenario_text = "seed: " + std::to_string(seed) + "\n";
  return config;
}

struct Sent {
  std::vector<msg::Chart> charts;
  std::vector<msg::Tile> tiles;
  std::vector<msg::Mesh> meshes;
  std::int64_t made = 0;
};

/// What a pager sends in its first event, and how many tiles it has made by then.
Sent first_event(const TerrainPagerConfig& config) {
  NodeUnderTest<TerrainPagerNode> pager(config);
  pager.give("pose", pose_at(0_s, 50, 50));
  Sent sent;
  sent.charts = pager.step_until<msg::Chart>("chart", 0_s);
  sent.tiles = pager.step_until<msg::Tile>("tile", 0_s);
  sent.meshes = pager.step_until<msg::Mesh>("mesh", 0_s);
  sent.made = pager.node().statistics().made;
  return sent;
}

void check_equal(const Sent& a, const Sent& b) {
  REQUIRE(a.tiles.size() == b.tiles.size());
  REQUIRE((a.charts.size() == 1 && b.charts.size() == 1 && a.meshes.size() == 1 && b.meshes.size() == 1));
  CHECK(msg::to_value(a.charts[0]) == msg::to_value(b.charts[0]));
  CHECK(a.charts[0].height_m == b.charts[0].height_m);
  CHECK(a.meshes[0].vertex_m == b.meshes[0].vertex_m);
  for (std::size_t i = 0; i < a.tiles.size(); ++i) {
    CHECK(a.tiles[i].height_m == b.tiles[i].height_m);
    CHECK(a.tiles[i].facet_mean_square_slope == b.tiles[i].facet_mean_square_slope);
  }
}

}  // namespace

TEST_CASE("a later epoch of the same seabed makes nothing again and sends the same; another seed makes all") {
  const Sent first = first_event(hills(3));
  CHECK(first.made > 0);
  const Sent again = first_event(hills(3));
  CHECK(again.made == 0);
  check_equal(first, again);
  const Sent other = first_event(hills(4));
  CHECK(other.made > 0);
  CHECK_FALSE(other.tiles[0].height_m == first.tiles[0].height_m);
  const Sent back = first_event(hills(3));
  CHECK(back.made > 0);
  check_equal(first, back);
}
