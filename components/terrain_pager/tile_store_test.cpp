#include "components/terrain_pager/tile_store.h"

#include <algorithm>
#include <atomic>
#include <catch2/catch.hpp>
#include <set>
#include <stdexcept>

using namespace ensonify;
using pager::TileStore;
using terrain::TileKey;

namespace {

TileStore::TilePtr numbered(const TileKey& key) {
  auto tile = std::make_shared<msg::Tile>();
  tile->col = key.east;
  tile->row = key.north;
  return tile;
}

/// Makes numbered tiles and counts how many of them live, in the store or with those who took them.
struct Census {
  std::atomic<int> alive = 0, most_alive = 0, made = 0;

  TileStore::TilePtr make(const TileKey& key) {
    const int now = ++alive;
    for (int most = most_alive; now > most && !most_alive.compare_exchange_weak(most, now);) {
    }
    ++made;
    auto* tile = new msg::Tile(*numbered(key));
    return {tile, [this](const msg::Tile* gone) {
              delete gone;
              --alive;
            }};
  }
};

}  // namespace

TEST_CASE("a tile taken is the tile asked for, held before or not") {
  TileStore store(numbered, {.threads = 2, .most = 10});
  store.hold({{1, 2}, {3, 4}});
  CHECK(store.take({3, 4}).tile->col == 3);
  CHECK(store.take({1, 2}).tile->row == 2);
  const auto never_held = store.take({7, 7});
  CHECK(never_held.tile->col == 7);
  CHECK(never_held.late);
  CHECK_FALSE(store.take({7, 7}).late);
}

TEST_CASE("a tile that cannot be made says why to whoever takes it") {
  TileStore store([](const TileKey&) -> TileStore::TilePtr { throw std::runtime_error("disk on fire"); },
                  {.threads = 1, .most = 10});
  store.hold({{0, 0}});
  CHECK_THROWS_WITH(store.take({0, 0}), "disk on fire");
}

TEST_CASE("each tile is made once, by whichever thread, while what is to be held changes") {
  std::mutex mutex;
  std::multiset<TileKey> made;
  TileStore store(
      [&](const TileKey& key) {
        {
          const std::scoped_lock lock(mutex);
          made.insert(key);
        }
        return numbered(key);
      },
      {.threads = 4, .most = 25});
  // A window of 5 x 5 tiles slides east; its western column falls out of memory, the rest stays.
  for (int shift = 0; shift < 50; ++shift) {
    std::vector<TileKey> keys;
    for (int i = 0; i < 25; ++i) keys.push_back({shift + i % 5, i / 5});
    store.hold(keys);
    for (const TileKey& key : keys) REQUIRE(store.take(key).tile->col == key.east);
  }
  const std::scoped_lock lock(mutex);
  CHECK(made.size() == 54 * 5);
  for (const TileKey& key : made) CHECK(made.count(key) == 1);
}

TEST_CASE("live tiles stay within the budget while demand changes faster than they are made") {
  Census census;
  {
    TileStore store([&](const TileKey& key) { return census.make(key); }, {.threads = 4, .most = 12});
    for (int round = 0; round < 400; ++round) {
      std::vector<TileKey> keys;
      for (int i = 0; i < 12; ++i) keys.push_back({round * 5 + i, 0});
      store.hold(keys);
      REQUIRE(store.take({round * 5 + 3, 0}).tile->col == round * 5 + 3);  // planned
      REQUIRE(store.take({-round, 9}).tile->row == 9);                     // not planned: another makes room
    }
    const int made_before = census.made;
    const auto statistics = store.statistics();
    CHECK(statistics.most_resident <= 12);
    CHECK(statistics.taken == 800);
    // Its four threads may each have made one that the store has not counted yet.
    CHECK(int(statistics.made) >= made_before - 4);
    CHECK(int(statistics.made) <= census.made);
    CHECK(statistics.resident <= 12);
  }
  // One more for the moment in which a tile that was taken has been forgotten by the store.
  CHECK(census.most_alive <= 13);
  CHECK(census.alive == 0);
}

TEST_CASE("the least important tile makes room for one that is taken and not held") {
  Census census;
  TileStore store([&](const TileKey& key) { return census.make(key); }, {.threads = 1, .most = 3});
  store.hold({{0, 0}, {1, 0}, {2, 0}});
  for (int i = 0; i < 3; ++i) store.take({i, 0});
  store.take({9, 9});
  CHECK(census.made == 4);
  CHECK_FALSE(store.take({0, 0}).late);
  CHECK_FALSE(store.take({1, 0}).late);
  CHECK(store.take({2, 0}).late);
}

TEST_CASE("tiles that are ready when they are taken have a margin, late ones a wait") {
  TileStore store(numbered, {.threads = 1, .most = 3});
  store.take({0, 0});
  CHECK(store.statistics().late == 1);
  CHECK(store.statistics().least_margin_s < 0.0);
  store.hold({{1, 0}});
  while (store.statistics().made < 2) std::this_thread::yield();
  CHECK_FALSE(store.take({1, 0}).late);
  CHECK(store.statistics().late == 1);
}
