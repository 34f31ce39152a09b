// How long a head takes to adapt its mesh, Embree's part included, and what that keeps of the tiles.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <limits>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "kernels/acoustics/trace/scene.h"
#include "kernels/acoustics/trace/views.h"
#include "kernels/base/random/stream.h"
#include "kernels/mesh/progressive/hierarchy.h"
#include "kernels/mesh/progressive/objects.h"
#include "kernels/mesh/progressive/testing/meshes.h"
#include "tests/support/fan.h"

using namespace ensonify;

namespace {

constexpr double kSide_m = 102.4;  // of a tile of 1024 cells of 0.1 m
const trace::TransmitVolume kFan = trace::mills_cross_volume(50.0, 50.0, 1.13);

/// Relief that repeats from tile to tile, so that a world of any size costs one.
const terrain::Tile& relief(double depth_m) {
  static std::map<double, terrain::Tile> made;
  const auto found = made.find(depth_m);
  if (found != made.end()) return found->second;
  const double turn = 2.0 * std::numbers::pi / kSide_m;
  return made[depth_m] = terrain::sample_tile({.spacing_m = 0.1}, {0, 0}, [&](double x, double y) {
           return -depth_m + std::sin(2 * turn * x) * std::cos(3 * turn * y) +
                  0.1 * std::sin(150 * turn * x) * std::sin(90 * turn * y);
         });
}

/// The tiles that a pager holds around the vehicle.
class World {
 public:
  World(double depth_m, bool endless) : scene_({0, 0}, {.enabled = true}), tile_(relief(depth_m)), endless_(endless) {}

  void page(const frames::Vec2& place, double margin_m) {
    const auto reach = static_cast<int>(std::ceil(margin_m / kSide_m));
    const int east = tile_at(place.x()), north = tile_at(place.y());
    for (int i = -reach - 1; i <= reach + 1; ++i) {
      for (int j = -reach - 1; j <= reach + 1; ++j) {
        const terrain::TileKey key{east + i, north + j};
        if (!endless_ && !(key == terrain::TileKey{0, 0})) continue;
        const double distance = std::hypot(gap_m(key.east, place.x()), gap_m(key.north, place.y()));
        if (distance > margin_m + 50.0) scene_.remove(key);
        if (distance > margin_m || scene_.contains(key)) continue;
        tile_.origin_enu_m = {kSide_m * (key.east - 0.5), kSide_m * (key.north - 0.5)};
        scene_.insert(key, tile_);
      }
    }
  }
  trace::Scene& scene() { return scene_; }
  double paged_triangles() const { return 2.0 * 1024 * 1024 * static_cast<double>(scene_.size()); }

 private:
  static int tile_at(double x) { return static_cast<int>(std::floor(x / kSide_m + 0.5)); }
  static double gap_m(int tile, double x) { return std::max(0.0, std::abs(x - kSide_m * tile) - 0.5 * kSide_m); }

  trace::Scene scene_;
  terrain::Tile tile_;
  bool endless_;
};

struct Track {
  double speed_mps, rate_hz, turn_radps;
  frames::HeadPose at(int ping) const {
    const double t = ping / rate_hz, heading = 0.3 + turn_radps * t;
    const double radius = turn_radps == 0.0 ? 0.0 : speed_mps / turn_radps;
    const frames::Vec2 place =
        turn_radps == 0.0
            ? frames::Vec2(speed_mps * t * frames::Vec2(std::sin(0.3), std::cos(0.3)))
            : frames::Vec2(radius * (std::cos(0.3) - std::cos(heading)), radius * (std::sin(heading) - std::sin(0.3)));
    return {{place.x(), place.y(), -1.0},
            frames::enu_from_body(frames::Attitude{heading, 0.02 * std::sin(t), 0.03 * std::cos(t)})};
  }
};

double seconds_of(const auto& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Times of adaptations.
class Clocks {
 public:
  void time(benchmark::State& state, const auto& work) {
    const std::clock_t start = std::clock();
    wall_s_.push_back(seconds_of(work));
    processor_s_.push_back(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
    state.SetIterationTime(wall_s_.back());
  }
  void report(benchmark::State& state) const {
    state.counters["worst_ms"] = 1e3 * *std::ranges::max_element(wall_s_);
    state.counters["worst_cpu_ms"] = 1e3 * *std::ranges::max_element(processor_s_);
    double sum = 0.0;
    for (const double s : processor_s_) sum += s;
    state.counters["mean_cpu_ms"] = 1e3 * sum / static_cast<double>(processor_s_.size());
  }

 private:
  std::vector<double> processor_s_, wall_s_;
};

/// 50 m above the seabed, 130 degrees: a swath of 214 m.
void adapt(benchmark::State& state) {
  const Track track{0.1 * static_cast<double>(state.range(0)), static_cast<double>(state.range(1)),
                    static_cast<double>(state.range(2)) * std::numbers::pi / 180.0};
  World world(51.0, true);
  int ping = 0;
  world.page({0, 0}, 170.0);
  const auto views = [&] { return trace::views_of(kFan, track.at(ping), 130.0, {}, 2); };
  world.scene().adapted(views());
  Clocks clocks;
  double paged_over_held = std::numeric_limits<double>::infinity();
  for (auto _ : state) {
    ++ping;
    world.page(track.at(ping).position_enu_m.head<2>(), 170.0);
    clocks.time(state, [&] { world.scene().adapted(views()); });
    paged_over_held =
        std::min(paged_over_held, world.paged_triangles() / static_cast<double>(world.scene().triangles()));
  }
  clocks.report(state);
  state.counters["paged_over_held"] = paged_over_held;
}

/// An irregular mesh, and a head that passes along it, 0.4 m a ping.
struct Passed {
  progressive::TriangleMesh mesh;
  frames::HeadPose first;
  double max_range_m;

  frames::HeadPose at(int ping) const {
    frames::HeadPose head = first;
    head.position_enu_m.x() += 0.4 * ping;
    return head;
  }
};

/// A quay wall of 250 m, its vertices row_m apart up the piles and 0.3 m along; the head 12 m off it, rolled towards
/// it: half the fan intersects the wall.
Passed wall(double row_m) {
  const progressive::SheetPileWall piles{.from_enu_m = {-125.0, 0.0}, .to_enu_m = {125.0, 0.0}, .row_m = row_m};
  return {progressive::mesh_of(piles, {1, "wall"}),
          {{-40.0, -12.0, -2.0}, frames::enu_from_body(frames::Attitude{0.5 * std::numbers::pi, 0.02, 0.8})},
          60.0};
}

/// A survey of 450 m x 300 m as triangles, soundings some metre apart; 50 m above it.
Passed survey() {
  const random::Stream soundings{2, "soundings"};
  auto mesh = progressive::sheet(450, 300, [&](int i, int j) {
    const auto column = static_cast<std::uint64_t>(i), row = static_cast<std::uint64_t>(j);
    const double x = i - 225 + 0.7 * soundings.uniform(column, row, 0);
    const double y = j - 150 + 0.7 * soundings.uniform(column, row, 1);
    const double rough = 0.05 * soundings.normal(column, row, 2);
    return frames::Vec3(x, y, -51.0 + std::sin(0.12 * x) * std::cos(0.18 * y) + rough).cast<float>().eval();
  });
  return {std::move(mesh),
          {{-40.0, 0.0, -1.0}, frames::enu_from_body(frames::Attitude{0.5 * std::numbers::pi, 0.02, 0.03})},
          130.0};
}

/// A box that is less by so much on each side, where it is long.
Eigen::AlignedBox3d inside(Eigen::AlignedBox3d box, double by_m) {
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    if (box.sizes()[axis] < 10.0 * by_m) continue;
    box.min()[axis] += by_m;
    box.max()[axis] -= by_m;
  }
  return box;
}

/// Every ray of the main lobe must hit what it hits with the whole mesh there, to the bit, and every other one
/// something, but for those at the mesh's own edge.
void check_rays(const Passed& passed, const trace::Mesh& whole, const trace::Mesh& scene,
                const frames::HeadPose& head) {
  Eigen::AlignedBox3d box;
  for (const auto& vertex : passed.mesh.vertex_m) box.extend(passed.mesh.origin_enu_m + vertex.cast<double>());
  const Eigen::AlignedBox3d well_inside = inside(box, 1.0);
  trace::Rays rays;
  trace::Fan({.half_swath_rad = 1.13, .across = 1024}).fill({1, "rays"}, 0, rays);
  trace::Hits all, some;
  whole.trace(head, rays, static_cast<float>(passed.max_range_m), all);
  scene.trace(head, rays, static_cast<float>(passed.max_range_m), some);
  int main_lobe = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (!all[i].hit()) continue;
    const auto sine = static_cast<double>(rays[i].direction_head.x());
    const bool main = kFan.sine.main_low <= sine && sine <= kFan.sine.main_high;
    main_lobe += main ? 1 : 0;
    const bool lost = !some[i].hit() && well_inside.contains(all[i].position_enu_m);
    if (!lost && (!main || (all[i].range_m == some[i].range_m && all[i].normal_enu == some[i].normal_enu))) continue;
    std::fprintf(stderr, lost ? "a ray is lost\n" : "a ray of the main lobe hits another mesh\n");
    std::exit(1);
  }
  if (main_lobe > 1000) return;
  std::fprintf(stderr, "hardly a ray hits the mesh\n");
  std::exit(1);
}

void adapt_irregular(benchmark::State& state, const Passed& passed) {
  const trace::IrregularMesh mesh{progressive::hierarchy_of(passed.mesh, progressive::collapses_of(passed.mesh))};
  trace::Scene whole({0, 0}), scene({0, 0}, {.enabled = true});
  whole.insert(0, mesh);
  scene.insert(0, mesh);
  const auto views = [&](int ping) { return trace::views_of(kFan, passed.at(ping), passed.max_range_m, {}, 2); };
  scene.adapted(views(0));  // its memory is there, as in all pings but a head's first
  Clocks clocks;
  double whole_over_held = std::numeric_limits<double>::infinity();
  int ping = 0;
  for (auto _ : state) {
    ++ping;
    clocks.time(state, [&] { scene.adapted(views(ping)); });
    whole_over_held =
        std::min(whole_over_held, static_cast<double>(whole.triangles()) / static_cast<double>(scene.triangles()));
    if (ping % 30 == 0) check_rays(passed, whole.adapted(), scene.adapted(views(ping)), passed.at(ping));
  }
  clocks.report(state);
  state.counters["triangles"] = static_cast<double>(passed.mesh.triangle.size());
  state.counters["whole_over_held"] = whole_over_held;
}

void adapt_to_wall(benchmark::State& state) {
  adapt_irregular(state, wall(1e-2 * static_cast<double>(state.range(0))));
}
void adapt_to_survey(benchmark::State& state) { adapt_irregular(state, survey()); }

/// Paging, adaptation and rays over a world of one tile (10^6 posts), and of tiles without end; 20 m above the seabed,
/// so that the swath fits on the tile. In turns: what the endless one takes more.
void endless_over_small(benchmark::State& state) {
  World small(21.0, false), endless(21.0, true);
  const Track straight{4.0, 10.0, 0.0};
  trace::Rays rays;
  trace::Fan({.half_swath_rad = 1.13, .across = 1024}).fill({1, "rays"}, 0, rays);
  trace::Hits hits;
  double small_s = 0.0, endless_s = 0.0;
  int ping = 0;
  const auto one = [&](World& world, const frames::HeadPose& head) {
    const std::clock_t start = std::clock();
    world.page(head.position_enu_m.head<2>(), 83.0);
    world.scene().adapted(trace::views_of(kFan, head, 52.0, {}, 2)).trace(head, rays, 52.0F, hits);
    return static_cast<double>(std::clock() - start);
  };
  for (auto _ : state) {
    ++ping;
    // To and fro over 4 m in the middle of the one tile, as fast as over the endless ones.
    const int phase = ping % 20;
    const double small_part = one(small, straight.at(phase < 10 ? phase - 5 : 15 - phase));
    const double endless_part = one(endless, straight.at(ping));
    if (ping <= 20) continue;
    small_s += small_part;
    endless_s += endless_part;
  }
  state.counters["endless/small"] = endless_s / small_s;
}

BENCHMARK(adapt)
    ->ArgNames({"dm/s", "Hz", "deg/s"})
    ->Args({20, 10, 0})
    ->Args({40, 5, 0})
    ->Args({40, 10, 0})
    ->Args({20, 10, 6})
    ->Args({40, 5, 6})
    ->UseManualTime()
    ->Iterations(200)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(adapt_to_wall)
    ->ArgName("row_cm")
    ->Arg(100)
    ->Arg(20)
    ->UseManualTime()
    ->Iterations(150)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(adapt_to_survey)->UseManualTime()->Iterations(150)->Unit(benchmark::kMillisecond);
BENCHMARK(endless_over_small)->Iterations(400)->Unit(benchmark::kMillisecond);

/// The bench is void if a ray gets lost.
void check() {
  World world(51.0, true);
  world.page({0, 0}, 170.0);
  const frames::HeadPose head = Track{4.0, 5.0, 0.1}.at(3);
  const trace::Mesh mesh = world.scene().adapted(trace::views_of(kFan, head, 130.0, {}, 2));
  trace::Rays rays;
  trace::Fan({.half_swath_rad = 1.13, .across = 1024}).fill({1, "rays"}, 0, rays);
  trace::Hits hits;
  mesh.trace(head, rays, 130.0F, hits);
  for (const trace::Hit& hit : hits) {
    if (hit.hit()) continue;
    std::fprintf(stderr, "a ray is lost\n");
    std::exit(1);
  }
}

}  // namespace

int main(int argc, char** argv) {
  check();
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
