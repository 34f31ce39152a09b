#include "tools/terrain/import/fill.h"

#include <cmath>
#include <utility>
#include <vector>

#include "components/errors/exit_error.h"
#include "components/terrain/fill_holes.h"

namespace ensonify::terrain_import {
namespace {

constexpr int kSmoothing = 3;  // passes

}  // namespace

HoleFacts fill(Mosaic& mosaic, const FillOptions& options) {
  terrain::Tile& tile = mosaic.tile();
  const survey_grid::Surface surface{tile.columns, tile.rows, tile.spacing_m, tile.height_m};
  const auto holes = survey_grid::holes_of(surface);
  const auto to_be_filled = [&](const survey_grid::Hole& hole) {
    return options.method != FillOptions::Method::kNone && !hole.at_rim &&
           hole.reach_spacings * tile.spacing_m <= options.reach_m;
  };
  HoleFacts facts;
  for (const auto& hole : holes.hole) {
    const double area_m2 = static_cast<double>(hole.posts) * tile.spacing_m * tile.spacing_m;
    if (hole.at_rim) {
      facts.outside_posts += hole.posts;
    } else if (to_be_filled(hole)) {
      ++facts.filled;
      facts.filled_posts += hole.posts;
    } else {
      ++facts.holes;
      facts.hole_posts += hole.posts;
      if (area_m2 <= facts.largest_m2) continue;
      facts.largest_m2 = area_m2;
      facts.largest_at_enu_m = tile.position_enu_m(hole.column, hole.row).head<2>();
    }
  }
  if (facts.filled == 0) return facts;
  std::vector<float> filled = tile.height_m;
  const int smoothing = options.method == FillOptions::Method::kSmooth ? kSmoothing : 0;
  const std::string fault =
      source::fill_holes(filled, tile.columns, tile.rows, options.reach_m / tile.spacing_m + 2.0, smoothing);
  if (!fault.empty()) throw UserError("--fill: the holes cannot be filled: " + fault);
  for (std::size_t post = 0; post < filled.size(); ++post) {
    const std::int32_t hole = holes.of_post[post];
    if (hole >= 0 && to_be_filled(holes.hole[static_cast<std::size_t>(hole)])) tile.height_m[post] = filled[post];
  }
  return facts;
}

}  // namespace ensonify::terrain_import
