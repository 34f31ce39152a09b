#include "components/terrain_pager/paging.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <set>

using namespace ensonify::pager;
using ensonify::paging::Motion;
using ensonify::terrain::Vec2;

namespace {

const TileGrid kGrid{Vec2::Zero(), 0.1, 1000, 1e-4};  // tiles of 100 m
const Box kTerrain{{-5000, -5000}, {5000, 5000}};

Paging::Rules rules(std::size_t most) { return {{60, 90}, {60.0, 0.5, 60.0, 160.0}, most}; }

/// Eastward at 4 m/s, twice a second.
Motion eastward(int step) { return {{-500 + 2.0 * step, 50}, {4, 0}, 0.0}; }

}  // namespace

TEST_CASE("on a straight track each tile is fetched long before it is published") {
  Paging paging(kGrid, kTerrain, rules(100));
  std::set<TileKey> before;
  for (int step = 0; step < 400; ++step) {
    const auto decision = paging.update(eastward(step));
    if (step > 0) {
      for (const TileKey& key : decision.publish) REQUIRE(before.contains(key));
    }
    before = {decision.in_memory.begin(), decision.in_memory.end()};
  }
}

TEST_CASE("memory is meant to hold what the budget allows, what is to be published first") {
  // 14 tiles are those within 60 m at most, 6, and a few ahead; those to the sides are not asked for.
  Paging paging(kGrid, kTerrain, {{60, 90}, {60.0, 0.5, 60.0, 60.0}, 14});
  int fetched = 0, again = 0;
  for (int step = 0; step < 400; ++step) {
    const auto decision = paging.update(eastward(step));
    REQUIRE(decision.in_memory.size() <= 14);
    for (std::size_t i = 0; i < decision.publish.size(); ++i) REQUIRE(decision.in_memory[i] == decision.publish[i]);
    fetched += decision.fetched;
    again += decision.fetched_again;
  }
  CHECK(fetched > 14);
  CHECK(again == 0);
}

TEST_CASE("what was ensonified last is kept until the budget needs its place") {
  Paging paging(kGrid, kTerrain, rules(40));
  for (int step = 0; step < 300; ++step) paging.update(eastward(step));  // from x = -500 to 98
  const auto kept = paging.update({{98, 50}, {0, 0}, 0.0}).in_memory;
  const auto column = [](const TileKey& key) { return key.east; };
  const auto oldest = std::ranges::min(kept, {}, column).east;
  CHECK(oldest < -1);   // tiles behind, which heads have given up
  CHECK(oldest >= -5);  // and none of where it was not
  CHECK(kept.size() == 40);
}

TEST_CASE("a track that sways to and fro fetches no tile twice once memory is full") {
  // In 60 s the predicted arcs sweep 36 m to both sides: a tile needed at one update is not at the next.
  Paging paging(kGrid, kTerrain, rules(40));
  int again = 0;
  std::size_t fewest = 100, most = 0;
  for (int step = 0; step < 800; ++step) {
    Motion motion = eastward(step);
    motion.turn_rate_radps = 0.005 * std::sin(0.7 * step);
    const auto decision = paging.update(motion);
    again += decision.fetched_again;
    if (step > 400) fewest = std::min(fewest, decision.in_memory.size());
    most = std::max(most, decision.in_memory.size());
  }
  CHECK(fewest == 40);
  CHECK(most == 40);
  CHECK(again == 0);
}

TEST_CASE("a turning vehicle fetches no tile twice") {
  // Two turns of 30 m radius, then a straight line, then two turns the other way; the budget has room for all around.
  Paging paging(kGrid, kTerrain, rules(100));
  Motion motion{{0, 0}, {4, 0}, 4.0 / 30.0};
  int fetched_later = 0, again = 0;
  for (int step = 0; step < 500; ++step) {
    motion.turn_rate_radps = step < 190 ? 4.0 / 30.0 : step < 310 ? 0.0 : -4.0 / 30.0;
    const Vec2 next = ensonify::paging::place_after(motion, 0.5);
    const double turned = 0.5 * motion.turn_rate_radps;
    const Vec2 v = motion.velocity_enu_mps;
    motion.velocity_enu_mps = {v.x() * std::cos(turned) - v.y() * std::sin(turned),
                               v.x() * std::sin(turned) + v.y() * std::cos(turned)};
    motion.position_enu_m = next;
    const auto decision = paging.update(motion);
    again += decision.fetched_again;
    if (step > 95 && step < 190) fetched_later += decision.fetched;  // the second turn
  }
  CHECK(fetched_later == 0);
  CHECK(again == 0);
}

TEST_CASE("outside the terrain nothing is published and nothing fetched") {
  Paging paging(kGrid, kTerrain, rules(100));
  const auto decision = paging.update({{9000, 0}, {4, 0}, 0.0});
  CHECK(decision.publish.empty());
  CHECK(decision.in_memory.empty());
}
