#pragma once

#include <algorithm>
#include <cmath>

#include "kernels/acoustics/trace/ray_distribution.h"

namespace ensonify {

/// Side of the patches of seabed that answer as one point, from what it is at preview or below. A patch has about as
/// many rays whatever the quality: with fewer, the next ping would not find it again. At most four times finer, which
/// misplaces nothing that a head resolves.
inline double patch_m(double at_preview_m, double quality) {
  return at_preview_m * std::clamp(std::sqrt(trace::RaySettings::kPreview / quality), 0.25, 1.0);
}

}  // namespace ensonify
