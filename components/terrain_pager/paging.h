#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "components/terrain_pager/config.h"
#include "kernels/mesh/paging/rules.h"
#include "messages/declarations.h"

namespace ensonify::pager {

using paging::Box;
using terrain::TileGrid;
using terrain::TileKey;

/// Decides which tiles heads hold and which of them memory is meant to hold: the rules of kernels/mesh/paging with what
/// they decided before. A function of the poses seen so far and of nothing else.
class Paging {
 public:
  struct Rules {
    paging::Margins margins;
    paging::Horizon horizon;
    std::size_t most = 100;  // tiles in memory
  };

  Paging(const TileGrid& grid, const Box& terrain, const Rules& rules)
      : grid_(grid), terrain_(terrain), rules_(rules) {}

  struct Decision {
    std::vector<TileKey> publish;    // nearest first
    std::vector<TileKey> release;    // by key
    std::vector<TileKey> in_memory;  // in order of importance, at most `most`
    int fetched = 0;                 // of these, not there at the update before
    int fetched_again = 0;           // of these, there at an earlier one
  };
  /// An update for where the vehicle is.
  Decision update(const paging::Motion& motion);

  /// Tiles to fetch before the first update when the vehicle will probably start there: those heads get at once. The
  /// rest may come while they ping.
  std::vector<TileKey> before_start(const paging::Vec2& place_enu_m) const;

 private:
  std::vector<TileKey> needed(const paging::Motion& motion, std::vector<TileKey> first) const;

  TileGrid grid_;
  Box terrain_;
  Rules rules_;
  std::int64_t updates_ = 0;
  std::set<TileKey> at_heads_;
  paging::LastWanted in_memory_;
  std::set<TileKey> ever_fetched_, ever_at_heads_;
};

/// Distance from the vehicle to which heads need the seabed, m. Each declares how far it can be set to receive
/// (`reach_m`); what an operator's command can ask for is within that, so tiles are there before a command takes
/// effect. A head that follows the depth by itself (`auto_range`) has no use for more than what lies within 71 degrees
/// of nadir: three times the greatest depth + 20 m. Without any head it is this, too. Never less than the greatest
/// depth + 20 m: Doppler logs and altimeters point down at no more than 45 degrees.
double demanded_m(const std::map<std::string, msg::HeadDeclaration>& heads, double deepest_m);

/// Bytes of a tile's heights and classes.
std::size_t tile_bytes(const TileGrid& grid);

/// Tiles that the pager's memory holds at most.
std::size_t most_in_memory(const TerrainPagerConfig& config, const TileGrid& grid);

/// Throws ConfigError when heads could come to hold more than head_budget_mb, or when what they need at once and what
/// threads are making do not fit into budget_mb: said before anything is simulated, not by the kernel's OOM killer.
void check_budgets(const TerrainPagerConfig& config, const paging::Margins& margins, const TileGrid& grid,
                   const Box& terrain);

}  // namespace ensonify::pager
