#pragma once

#include <optional>

#include "kernels/mesh/progressive/mesh.h"

namespace ensonify::progressive {

/// A straight way seen from above, and the height from which up nothing may stand in it.
struct Way {
  frames::Vec2 from_enu_m = frames::Vec2::Zero();
  frames::Vec2 to_enu_m = frames::Vec2::Zero();
  double above_z_m = 0.0;
};

/// Distance along a track (m) at which the surface first crosses it: cuts the upright plane over it at or above its
/// height, at whatever height above. Empty when it does not. What comes within kSlack_m of the height does; a surface
/// that only touches the way from the side, with an upright triangle along it, may or may not. Exact but for what
/// floats round.
std::optional<double> first_crossing_m(const TriangleMesh& mesh, const Way& way);

}  // namespace ensonify::progressive
