#include "components/terrain_pager/paging.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>
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

Paging::Decision Paging::update(const paging::Motion& motion) {
  ++updates_;
  const std::vector<TileKey> held(at_heads_.begin(), at_heads_.end());
  auto exchange = paging::exchange(grid_, terrain_, motion.position_enu_m, rules_.margins, held);
  at_heads_.insert(exchange.give.begin(), exchange.give.end());
  ever_at_heads_.insert(exchange.give.begin(), exchange.give.end());
  for (const TileKey& key : exchange.take) at_heads_.erase(key);

  Decision decision;
  const std::vector<TileKey> needed_now = needed(motion, exchange.give);
  decision.in_memory = paging::to_hold(needed_now, in_memory_, rules_.most);
  decision.publish = std::move(exchange.give);
  decision.release = std::move(exchange.take);
  const std::set<TileKey> wanted(needed_now.begin(), needed_now.end());
  paging::LastWanted now;
  for (const TileKey& key : decision.in_memory) {
    const auto before = in_memory_.find(key);
    const bool within_reach =
        paging::distance_m(paging::box_of(grid_, key), motion.position_enu_m) <= rules_.margins.feed_m;
    now[key] = within_reach || wanted.contains(key) ? updates_ : before->second;
    if (before != in_memory_.end()) continue;
    ++decision.fetched;
    if (!ever_fetched_.insert(key).second) ++decision.fetched_again;
  }
  in_memory_ = std::move(now);
  return decision;
}

std::vector<TileKey> Paging::before_start(const paging::Vec2& place_enu_m) const {
  return paging::to_hold(paging::tiles_near(grid_, terrain_, place_enu_m, rules_.margins.feed_m), {}, rules_.most);
}

/// `first`, then what the track ahead needs and heads do not hold. What is only near is not needed when heads have had
/// it before: it lies behind.
std::vector<TileKey> Paging::needed(const paging::Motion& motion, std::vector<TileKey> first) const {
  for (const paging::Need& need : paging::needs(grid_, terrain_, motion, rules_.horizon)) {
    const bool only_near = std::isinf(need.due_s);
    if (!(only_near ? ever_at_heads_ : at_heads_).contains(need.key)) first.push_back(need.key);
  }
  return first;
}

double demanded_m(const std::map<std::string, msg::HeadDeclaration>& heads, double deepest_m) {
  const double by_depth_m = 3.0 * deepest_m + 20.0;
  double demanded = deepest_m + 20.0;
  bool any = false;
  for (const auto& [process, head] : heads) {
    if (head.reach_m <= 0.0) continue;
    any = true;
    demanded = std::max(demanded, head.auto_range ? std::min(head.reach_m, by_depth_m) : head.reach_m);
  }
  return any ? demanded : by_depth_m;
}

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
