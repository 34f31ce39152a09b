#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "components/sonar/sea_acoustics.h"
#include "components/sonar/testing/seabed.h"
#include "components/sonar/tile_set.h"
#include "kernels/acoustics/trace/ray_distribution.h"

using namespace ensonify;
using Catch::WithinAbs;

namespace {

/// Dunes, and roughness of 0.7 m whose slopes are 0.1 rms: posts 0.4 m apart do not show it.
double rough(double east, double north) {
  return -22.0 + 0.3 * std::sin(0.3 * east) * std::cos(0.2 * north) +
         0.016 * std::sin(8.0 * east + 4.0 * north) * std::cos(5.0 * north);
}

TileSet tiles_of(const trace::LevelOfDetail& detail) {
  TileSet tiles(detail);
  tiles.insert(tile_of(102.4, 0.1, rough));
  return tiles;
}

struct Traced {
  trace::Rays rays;
  trace::Hits hits;
};

const trace::TransmitVolume kFan = trace::mills_cross_volume(50.0, 50.0, 1.0);

/// 20 m above the seabed, turned, rolled and pitched.
Traced traced(TileSet& tiles, const WaterProfile& profile, double east_m = 0.0) {
  World world;
  world.water.profile = profile;
  world.seabed.sediments[0] = seabed::Lambert{-25.0};
  const SeaAcoustics sea(std::make_shared<const Environment>(world, 300e3), 300e3, {.motion = false}, {});
  const frames::HeadPose pose{{east_m + 3.0, 2.0, -2.0}, frames::enu_from_body({0.4, 0.03, -0.05})};
  trace::RayDistribution distribution(kFan, {.quality = 0.5, .range_resolution_m = 0.05}, {1, "rays"});
  const array::Pattern all_around;
  ShotMemory memory;
  const Shot shot{.poses = std::span(&pose, 1), .transmit = {&all_around, 1}, .rays_per_batch = 1U << 20};
  sea.insonify(shot, sea.mesh(shot, tiles.scene(), distribution, 45.0), distribution,
               echo::SpeckleCells(0.05, {1, "seabed"}), 45.0, memory);
  REQUIRE(memory.plan.rays() < shot.rays_per_batch);
  return {std::move(memory.batches[0].batch.rays), std::move(memory.batches[0].batch.hits)};
}

bool same(const Traced& a, std::size_t i, const Traced& b, std::size_t j) {
  return a.rays[i].direction_head == b.rays[j].direction_head && a.hits[i].position_enu_m == b.hits[j].position_enu_m &&
         a.hits[i].travel_time_s == b.hits[j].travel_time_s && a.hits[i].tube_m2 == b.hits[j].tube_m2 &&
         a.hits[i].sin_grazing == b.hits[j].sin_grazing;
}

bool in_main_lobe(const trace::Ray& ray) {
  const double sine = static_cast<double>(ray.direction_head.x());
  return kFan.sine.main_low < sine && sine < kFan.sine.main_high;
}

std::vector<std::size_t> main_lobe_of(const Traced& traced) {
  std::vector<std::size_t> rays;
  for (std::size_t i = 0; i < traced.rays.size(); ++i) {
    if (in_main_lobe(traced.rays[i])) rays.push_back(i);
  }
  return rays;
}

/// What side lobes bring back by Lambert's law, were they all as strong: integral of sin^2 / R^2 over their solid
/// angle.
double side_lobes_db(const Traced& traced) {
  double sum = 0.0;
  for (std::size_t i = 0; i < traced.rays.size(); ++i) {
    const trace::Hit& hit = traced.hits[i];
    if (!hit.hit() || in_main_lobe(traced.rays[i])) continue;
    const double sine_over_range = static_cast<double>(hit.sin_grazing / hit.path_length_m);
    sum += static_cast<double>(traced.rays[i].solid_angle_sr) * sine_over_range * sine_over_range;
  }
  return 10.0 * std::log10(sum);
}

}  // namespace

TEST_CASE("level of detail keeps main lobe hits bit-equal and side lobes within 0.1 dB") {
  TileSet full = tiles_of({}), adapted = tiles_of({.enabled = true});
  const WaterProfile uniform{.sound_speed_mps = 1500.0};
  const WaterProfile thermocline{.samples = {{.depth_m = 0.0, .sound_speed_mps = 1520.0},
                                             {.depth_m = 10.0, .sound_speed_mps = 1515.0},
                                             {.depth_m = 15.0, .sound_speed_mps = 1490.0}}};
  for (const WaterProfile& profile : {uniform, thermocline}) {
    const Traced all = traced(full, profile), some = traced(adapted, profile);
    CHECK(adapted.scene().triangles() < full.scene().triangles() / 4);
    const auto main_of_all = main_lobe_of(all), main_of_some = main_lobe_of(some);
    REQUIRE(main_of_all.size() == main_of_some.size());
    REQUIRE(main_of_all.size() > 10'000);
    std::size_t different = 0;
    for (std::size_t i = 0; i < main_of_all.size(); ++i) {
      different += same(all, main_of_all[i], some, main_of_some[i]) ? 0U : 1U;
    }
    CHECK(different == 0);
    CHECK(all.rays.size() != some.rays.size());  // side lobes do see another mesh
    CHECK_THAT(side_lobes_db(some), WithinAbs(side_lobes_db(all), 0.1));
  }
}

TEST_CASE("kilometres from the world's origin a ping is the same whatever way the head took") {
  const WaterProfile water{.sound_speed_mps = 1500.0};
  const auto tile_at = [](std::int64_t col) {
    msg::Tile tile = tile_of(102.4, 0.1, rough);
    tile.col = col;
    tile.origin_east_m += 102.4 * static_cast<double>(col);
    return tile;
  };
  for (const bool enabled : {true, false}) {
    CAPTURE(enabled);
    TileSet fresh({.enabled = enabled}), wandered({.enabled = enabled});
    for (const std::int64_t col : {0, 31}) {  // as far as 3.2 km
      wandered.insert(tile_at(col));
      traced(wandered, water, 102.4 * static_cast<double>(col));
    }
    for (TileSet* tiles : {&wandered, &fresh}) tiles->insert(tile_at(50));
    const Traced a = traced(wandered, water, 5120.0), b = traced(fresh, water, 5120.0);
    REQUIRE(a.rays.size() == b.rays.size());
    std::size_t different = 0, hits = 0;
    for (std::size_t i = 0; i < a.rays.size(); ++i) {
      different += same(a, i, b, i) ? 0U : 1U;
      hits += a.hits[i].hit() ? 1U : 0U;
    }
    CHECK(different == 0);
    CHECK(hits > 10'000);
  }
}
