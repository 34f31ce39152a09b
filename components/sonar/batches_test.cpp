#include <catch2/catch.hpp>
#include <cmath>

#include "components/sonar/sea_acoustics.h"
#include "components/sonar/testing/seabed.h"
#include "components/sonar/tile_set.h"

using namespace ensonify;

TEST_CASE("a shot insonifies the same scatterers in batches of any size, in memory of three") {
  TileSet tiles;
  tiles.insert(tile_of(200.0, 0.5, [](double east, double north) { return -20.0 + std::sin(east) + 0.1 * north; }));
  World world;
  world.water.profile.samples = {{.depth_m = 0.0, .sound_speed_mps = 1500.0},
                                 {.depth_m = 50.0, .sound_speed_mps = 1480.0}};
  world.seabed.sediments[0] = seabed::Lambert{-25.0};
  const SeaAcoustics sea(std::make_shared<const Environment>(world, 300e3), 300e3, {}, {});
  const frames::HeadPose pose{{3.0, 2.0, -2.0}, frames::enu_from_body({0.4, 0.03, -0.05})};
  const trace::RayDistribution distribution(trace::mills_cross_volume(50.0, 50.0, 1.0),
                                            {.quality = 1.0, .range_resolution_m = 0.1}, {1, "rays"});
  const echo::SpeckleCells cells(0.1, {1, "seabed"});
  const array::Pattern all_around;
  ShotMemory whole_memory;
  const auto insonify = [&](std::size_t size, ShotMemory& memory) {
    const Shot shot{.poses = std::span(&pose, 1), .transmit = {&all_around, 1}, .rays_per_batch = size};
    return sea.insonify(shot, sea.mesh(shot, tiles.scene(), distribution, 60.0), distribution, cells, 60.0, memory);
  };
  const Insonified whole = insonify(1U << 20, whole_memory);
  REQUIRE(whole_memory.plan.rays() > 8192);
  REQUIRE(whole.scatterers.size() > 1000);
  for (const std::size_t size : {std::size_t{160}, std::size_t{4096}}) {
    ShotMemory memory;
    const Insonified some = insonify(size, memory);
    CHECK(some.scatterers == whole.scatterers);
    CHECK(some.sums.hits == whole.sums.hits);
    CHECK(some.sums.in_lobe == whole.sums.in_lobe);
    CHECK(some.seabed_depth_m == whole.seabed_depth_m);
    for (const ShotMemory::OfBatch& own : memory.batches) {
      CHECK(own.batch.rays.size() <= size);
      CHECK(own.source_upa2m2.capacity() <= size);
      CHECK(own.batch.hits.range_m.capacity() <= size + size / 8);
    }
  }
}
