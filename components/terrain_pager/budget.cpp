#include "components/terrain_pager/budget.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace ensonify::pager {
namespace {

constexpr double kMega = 1e6;

double mb_of(std::size_t tiles, const TileGrid& grid) { return static_cast<double>(tiles * tile_bytes(grid)) / kMega; }

/// No more than the terrain has.
std::size_t most_near(const TileGrid& grid, const Box& terrain, double margin_m) {
  const double across_m = (terrain.high - terrain.low).norm();
  if (margin_m < across_m) return paging::most_tiles_near(grid.side_m(), margin_m);
  return paging::tiles_near(grid, terrain, terrain.low, across_m).size();
}

}  // namespace

std::size_t tile_bytes(const TileGrid& grid) {
  const auto side = static_cast<std::size_t>(grid.cells) + 1;
  return side * side * (sizeof(float) + sizeof(std::uint8_t));
}

std::size_t most_in_memory(const TerrainPagerConfig& config, const TileGrid& grid) {
  const auto fitting = static_cast<std::size_t>(config.budget_mb * kMega / static_cast<double>(tile_bytes(grid)));
  return std::max(fitting, static_cast<std::size_t>(config.threads) + 1);
}

void check_budgets(const TerrainPagerConfig& config, const paging::Margins& margins, const TileGrid& grid,
                   const Box& terrain) {
  std::vector<ConfigProblem> problems;
  const std::size_t at_heads = most_near(grid, terrain, margins.release_m);
  if (mb_of(at_heads, grid) > config.head_budget_mb) {
    problems.push_back(
        {{config.scenario_file, 0, 0},
         "seabed.post_spacing_m",
         fmt::format("posts {:g} m apart make up to {} tiles within {:.0f} m of the vehicle, {:.0f} MB in "
                     "every head; at most {:g} MB are allowed: widen the posts, narrow feed_margin_m, or "
                     "raise the pager's head_budget_mb",
                     grid.spacing_m, at_heads, margins.release_m, mb_of(at_heads, grid), config.head_budget_mb)});
  }
  const std::size_t at_once = most_near(grid, terrain, margins.feed_m) + static_cast<std::size_t>(config.threads);
  if (mb_of(at_once, grid) > config.budget_mb) {
    problems.push_back(
        {config.place, "budget_mb",
         fmt::format("{:g} does not hold the {} tiles that may lie within {:.0f} m of the vehicle and {} "
                     "being made; at least {:.0f} are needed",
                     config.budget_mb, at_once - static_cast<std::size_t>(config.threads), margins.feed_m,
                     config.threads, std::ceil(mb_of(at_once, grid)))});
  }
  if (!problems.empty()) throw ConfigError(problems);
}

}  // namespace ensonify::pager
