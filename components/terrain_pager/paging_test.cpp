#include "components/terrain_pager/paging.h"

#include <catch2/catch.hpp>
#include <set>

using namespace ensonify::pager;

namespace {

const TileGrid kGrid{Vec2::Zero(), 0.1, 1000, 1e-4};  // tiles of 100 m
const Extent kTerrain{-1000, -1000, 1000, 1000};
const Margins kMargins{60, 90, 300};

}  // namespace

TEST_CASE("tiles nearer than the feed margin are published once, nearest first") {
  Paging paging(kGrid, kTerrain, kMargins);
  const auto first = paging.decide({50, 30}, {50, 30});
  REQUIRE(first.publish.size() ==
          6);  // 60 m reaches west, east, south and, by 50^2 + 30^2 < 60^2, the southern corners
  CHECK(first.publish[0] == TileKey{0, 0});
  CHECK(first.publish[1] == TileKey{0, -1});
  CHECK(paging.decide({50, 30}, {50, 30}).publish.empty());
}

TEST_CASE("tiles are given up only beyond the release margin") {
  Paging paging(kGrid, kTerrain, kMargins);
  paging.decide({50, 50}, {50, 50});
  CHECK(paging.decide({189, 50}, {189, 50}).release.size() == 3);  // the column 50..., 239 - 50 m west of it
  const auto circling = paging.decide({185, 50}, {185, 50});
  CHECK(circling.release.empty());
  CHECK(circling.publish.empty());
}

TEST_CASE("along any track a head holds every tile within the margin, and none twice") {
  Paging paging(kGrid, kTerrain, kMargins);
  std::set<TileKey> held;
  for (double t = 0.0; t < 600.0; t += 0.5) {
    const Vec2 place(-500 + 1.7 * t, 200 * std::sin(t / 40));
    const auto decision = paging.decide(place, place);
    for (const auto& key : decision.publish) REQUIRE(held.insert(key).second);
    for (const auto& key : decision.release) REQUIRE(held.erase(key) == 1);
    for (const auto& key : paging.within(place, kMargins.feed_m)) REQUIRE(held.contains(key));
  }
}

TEST_CASE("nothing is published outside the terrain") {
  Paging paging(kGrid, kTerrain, kMargins);
  CHECK(paging.decide({5000, 0}, {5000, 0}).publish.empty());
  for (const auto& key : paging.within({990, 990}, 500)) {
    CHECK(key.east <= 10);
    CHECK(key.north <= 10);
  }
}
