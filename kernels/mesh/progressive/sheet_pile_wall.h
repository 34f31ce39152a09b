#pragma once

#include <cstdint>

#include "kernels/base/frames/attitude.h"
#include "kernels/base/random/stream.h"
#include "kernels/mesh/progressive/mesh.h"

namespace ensonify::progressive {

/// A quay wall of steel U piles: pans that stand in and out in turn, with inclined webs between. Dimensions as of PU 18
/// [ArcelorMittal2013], whose pans and webs take about as much of the width each.
struct SheetPileWall {
  frames::Vec2 from_enu_m = frames::Vec2::Zero();
  frames::Vec2 to_enu_m{100.0, 0.0};
  double foot_depth_m = 15.0;     // below chart datum: in the seabed
  double top_height_m = 0.0;      // above it
  double pile_width_m = 0.6;      // from interlock to interlock, along the wall
  double profile_depth_m = 0.43;  // across the wall, from pan to pan
  double out_of_line_m = 0.015;   // standard deviation of a pile's place across the wall
  double row_m = 1.0;             // vertices up a pile are so far apart, or less
};

/// Its vertices: what a mesh of it costs.
double vertices_of(const SheetPileWall& wall);

/// The surface, without thickness. The last pile ends where the wall does, or a little before. Throws
/// std::invalid_argument for a wall shorter than a pile, of no height, or with a width, row or depth that is not
/// positive.
TriangleMesh mesh_of(const SheetPileWall& wall, const random::Stream& stream);

}  // namespace ensonify::progressive
