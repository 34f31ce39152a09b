#pragma once

#include <span>
#include <vector>

#include "kernels/mesh/solids/solid.h"

/// Ropes, hoses and chains: bodies along a line.
namespace ensonify::solids {

/// A catenary from south to north between two ends of equal height, as points that straight pieces join: none of these
/// leaves it by more than `sagitta_m`, as far as 4,000 pieces go. Its origin is midway between the ends and halfway
/// down. A sag of 0 is straight.
std::vector<frames::Vec3> catenary(double length_m, double sag_m, double sagitta_m);

/// The lowest heights along a line that are nowhere below the ground and between which a rope can lie: where it spans
/// freely it hangs in a parabola of curvature 1 / `taut_m`, the weight of a metre of it in water over its tension. On
/// the ground it may bend downwards as it likes. 0: it is limp and lies on the ground everywhere.
std::vector<double> laid_heights(std::span<const double> along_m, std::span<const double> ground_m, double taut_m);

/// A rope about a line of two points or more, its ends closed. Its sides leave the round by no more than `sagitta_m`,
/// as far as 100 of them go.
Surface rope_along(std::span<const frames::Vec3> line_m, double diameter_m, double sagitta_m);

/// Links of ship's chain about a line, as common links of ISO 1704 are: of wire of this diameter, six of them long and
/// 3.6 wide, by turns upright and level. As many as the line has room for, one at least. Their wire has 16 sides at
/// most. Throws std::invalid_argument for more than a million triangles, some 1,700 links.
Surface chain_along(std::span<const frames::Vec3> line_m, double wire_m, double sagitta_m);

}  // namespace ensonify::solids
