// How fast tiles of generated seabeds are paged in: posts per second, heights on their lattice and classes, two threads
// as the pager has. The case is checked before it is timed: a tile made twice has the same bits.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "components/terrain/source_of.h"
#include "components/terrain/terrain_source.h"
#include "scenarios/world/world.h"

using namespace ensonify;

namespace {

void page_in(benchmark::State& state, const std::string& name) {
  static std::shared_ptr<const source::TerrainSource> terrain;
  static terrain::TileGrid grid;
  if (state.thread_index() == 0) {
    const char* folder = std::getenv("ENSONIFY_SOURCE");
    const World world = read_world(std::string(folder ? folder : ".") + "/scenarios/" + name + "/scenario.yaml");
    const source::TerrainOptions options{world.site, world.seabed, "", 1, {}};
    terrain = source::source_of(options);
    grid = {{0.0, 0.0}, source::post_spacing_m(options, *terrain), 1024, source::lsb_m(options, *terrain)};
  }
  constexpr std::size_t kSide = 1025;
  std::vector<float> height_m(kSide * kSide), twice(kSide * kSide);
  std::vector<std::uint8_t> sediment(height_m.size());
  std::int32_t east = 0;
  for (auto _ : state) {
    fill_tile(*terrain, grid, {-1 - state.thread_index(), east}, height_m, sediment);
    east = (east + 1) % 2;
  }
  if (state.thread_index() == 0) {
    fill_tile(*terrain, grid, {-1, 0}, height_m, sediment);
    fill_tile(*terrain, grid, {-1, 0}, twice, sediment);
    if (std::isnan(height_m[kSide + 1]) || height_m != twice) {
      std::fprintf(stderr, "%s: the tile is not the same when it is made again\n", name.c_str());
      std::exit(1);
    }
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(height_m.size()));
}

BENCHMARK_CAPTURE(page_in, survey_10km, "survey_10km")->Threads(2)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(page_in, billion, "billion")->Threads(2)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(page_in, slope_overlap, "slope_overlap")->Threads(2)->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
