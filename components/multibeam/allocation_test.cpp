#include <atomic>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <new>

#include "components/multibeam/head.h"
#include "components/multibeam/testing/head.h"
#include "components/sonar/tile_set.h"

namespace {

std::atomic<int> allocations{0};

}  // namespace

// Every `new` of this program, from whichever thread. Not inline: GCC 12 would take an inlined pair for a mismatch.
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

using namespace ensonify;

TEST_CASE("after the first ping, receiving allocates nothing") {
  msg::Tile tile;
  tile.origin_east_m = tile.origin_north_m = -64.0;
  tile.spacing_m = 0.5;
  tile.height_m = msg::Array<float>({257, 257});
  for (float& height : tile.height_m.flat()) height = -20.0F;
  tile.sediment = msg::Array<std::uint8_t>({257, 257});
  TileSet tiles;
  tiles.insert(tile);
  tile.col = tile.row = 9;  // and a block of 2 m, whose facets have rays of their own
  tile.origin_east_m = tile.origin_north_m = -1.0;
  tile.spacing_m = 0.25;
  tile.height_m = msg::Array<float>({9, 9});
  for (float& height : tile.height_m.flat()) height = -18.0F;
  tile.sediment = msg::Array<std::uint8_t>({9, 9});
  tiles.insert(tile);
  frames::PoseHistory truth(1'000'000'000);
  truth.push(0, {});

  const MultibeamConfig config = head_in_plain_water();
  const Steering steering = steer(config, config.swath_rad, {});
  const HeadSettings settings = config.start();
  Multibeam head(config, 0);
  Multibeam::Memory memory;
  const int before_anything = allocations;
  receive_echoes(head, {0, SimTime{0}, 60.0}, settings, steering, truth, tiles.scene(), memory);
  CHECK(allocations > before_anything);  // the count works
  receive_echoes(head, {1, SimTime{0}, 60.0}, settings, steering, truth, tiles.scene(), memory);
  const int before = allocations;
  for (int ping = 2; ping < 12; ++ping)
    receive_echoes(head, {ping, SimTime{0}, 60.0}, settings, steering, truth, tiles.scene(), memory);
  CHECK(allocations - before == 0);
}
