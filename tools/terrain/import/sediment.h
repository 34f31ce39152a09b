#pragma once

#include <array>

#include "tools/terrain/import/mosaic.h"

namespace ensonify::terrain_import {

/// Number of posts of each class; holes count for none.
using ClassPosts = std::array<std::int64_t, 256>;

/// Gives each post of the mosaic its sediment class: from the class raster (nearest cell), else from the backscatter
/// raster (interpolated, by thresholds), else from the first rule that holds, else the class of all others. Depths and
/// slopes are those of the posts, the slope that over one post to either side. Throws UserError.
ClassPosts classify(Mosaic& mosaic, const SedimentOptions& options);

}  // namespace ensonify::terrain_import
