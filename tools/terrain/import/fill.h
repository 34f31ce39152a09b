#pragma once

#include "tools/terrain/import/mosaic.h"

namespace ensonify::terrain_import {

/// The posts without a height, after filling.
struct HoleFacts {
  std::int64_t holes = 0, hole_posts = 0;                // inside the survey
  std::int64_t filled = 0, filled_posts = 0;             // more of them that were filled
  std::int64_t outside_posts = 0;                        // ground of the rectangle that was not surveyed
  double largest_m2 = 0.0;                               // of the holes that remain
  frames::Vec2 largest_at_enu_m = frames::Vec2::Zero();  // a post of that
};

/// Finds the holes of the mosaic and fills those that reach no farther than asked for. Throws UserError.
HoleFacts fill(Mosaic& mosaic, const FillOptions& options);

}  // namespace ensonify::terrain_import
