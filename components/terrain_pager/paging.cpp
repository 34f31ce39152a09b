#include "components/terrain_pager/paging.h"

#include <cmath>
#include <utility>

namespace ensonify::pager {

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

}  // namespace ensonify::pager
