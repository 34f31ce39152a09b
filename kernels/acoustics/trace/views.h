#pragma once

#include <array>

#include "kernels/acoustics/trace/ray_distribution.h"
#include "kernels/base/frames/pose.h"
#include "kernels/mesh/lod/cover.h"
#include "kernels/water/refraction/profile.h"

namespace ensonify::trace {

/// Views of a transmission: its main lobe at full detail, all that rays go to at `side_lobes`.
std::array<lod::View, 2> views_of(const TransmitVolume& volume, const frames::HeadPose& head, double max_range_m,
                                  const lod::Water& water, std::int32_t side_lobes);

/// The speeds that paths can have between the surface and a depth.
lod::Water water_above(const refraction::SoundSpeedProfile& profile, double head_depth_m, double deepest_m);

}  // namespace ensonify::trace
