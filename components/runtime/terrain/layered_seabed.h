#pragma once

#include <string>
#include <vector>

#include "components/runtime/config/scenario_seabed.h"
#include "kernels/frames/local_projection.h"
#include "kernels/relief/marks.h"
#include "kernels/relief/seabed.h"

namespace ensonify::source {

/// The fields of kernels/relief that a scenario's layers ask for, joined. `origin` is the world's, for guides that are
/// read from files. Throws ConfigError, naming the layer, for what only shows when it is made: a guide that cannot be
/// read or has holes, numbers that do not go together.
relief::Seabed seabed_of(const LayeredSeabed& seabed, double post_spacing_m, const frames::Geodetic& origin);

/// A furrow, and the layer of trawl scars or anchor drags that has it.
struct NamedMark {
  std::string layer;
  relief::Mark mark;
};

/// All furrows that may reach into the seabed's rectangle, layer by layer: where they are, whether or not a mask, what
/// covers them or their age hides them.
std::vector<NamedMark> marks_of(const LayeredSeabed& seabed, double post_spacing_m);

}  // namespace ensonify::source
