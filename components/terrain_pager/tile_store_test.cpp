#include "components/terrain_pager/tile_store.h"

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

}  // namespace

TEST_CASE("a tile taken is the tile asked for, wanted before or not") {
  TileStore store(numbered, 2);
  store.want({{1, 2}, {3, 4}});
  CHECK(store.take({3, 4}).tile->col == 3);
  CHECK(store.take({1, 2}).tile->row == 2);
  const auto never_wanted = store.take({7, 7});
  CHECK(never_wanted.tile->col == 7);
  CHECK(never_wanted.late);
  CHECK_FALSE(store.take({7, 7}).late);
}

TEST_CASE("a tile that cannot be made says why to whoever takes it") {
  TileStore store([](const TileKey&) -> TileStore::TilePtr { throw std::runtime_error("disk on fire"); }, 1);
  store.want({{0, 0}});
  CHECK_THROWS_WITH(store.take({0, 0}), "disk on fire");
}

TEST_CASE("each wanted tile is made once, by whichever thread, while wishes change") {
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
      4);
  // A window of 5 x 5 tiles slides east; its western column falls out of memory, the rest stays.
  for (int shift = 0; shift < 50; ++shift) {
    std::vector<TileKey> keys;
    for (int i = 0; i < 25; ++i) keys.push_back({shift + i % 5, i / 5});
    store.want(keys);
    for (const TileKey& key : keys) REQUIRE(store.take(key).tile->col == key.east);
  }
  const std::scoped_lock lock(mutex);
  CHECK(made.size() == 54 * 5);
  for (const TileKey& key : made) CHECK(made.count(key) == 1);
}
