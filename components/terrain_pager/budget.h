#pragma once

#include "components/terrain_pager/config.h"
#include "components/terrain_pager/paging.h"

namespace ensonify::pager {

/// Bytes of a tile's heights and classes.
std::size_t tile_bytes(const TileGrid& grid);

/// Tiles that the pager's memory holds at most.
std::size_t most_in_memory(const TerrainPagerConfig& config, const TileGrid& grid);

/// Throws ConfigError when heads could come to hold more than head_budget_mb, or when what they need at once and what
/// threads are making do not fit into budget_mb: said before anything is simulated, not by the kernel's OOM killer.
void check_budgets(const TerrainPagerConfig& config, const paging::Margins& margins, const TileGrid& grid,
                   const Box& terrain);

}  // namespace ensonify::pager
