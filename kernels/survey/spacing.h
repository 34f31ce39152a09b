#pragma once

#include <span>

/// Cost of a survey: where lines go, how fast, how long. Values in, values out.
namespace ensonify::survey {

/// The swath that a survey counts on.
struct Swath {
  double half_angle_rad = 1.0472;  // either side of nadir, 0 .. 80 degrees
  double overlap = 0.1;            // of the next line's near half swath with what is covered, 0 .. 0.9
};

/// Reach of the swath to one side of a head that is `depth_m` above the bottom below it, across the line. The
/// bottom is a plane that deepens by `deepening` per metre to that side (a tangent). Infinite where it falls away as
/// steeply as the beam. From x = tan(angle) (depth + deepening x).
double reach_m(double depth_m, double deepening, double half_angle_rad);

/// The end of what is covered on one row along the survey: how far across the survey it lies, and the depth below the
/// head there.
struct CoveredEdge {
  double across_m = 0.0;
  double depth_m = 0.0;
};

/// Place of the next line across the survey: as far from what is covered as its near half swath reaches, less the
/// overlap. Its outermost beam there hits the bottom at the edge, where the depth is known: the reach is
/// depth tan(angle), whatever the slope. The row that reaches least decides, so that no gap is left. A line that would
/// lie beyond the survey's far edge lies in the middle of what is left. Throws std::invalid_argument without a row.
double next_line_across_m(std::span<const CoveredEdge> rows, const Swath& swath, double far_edge_m);

/// Lines laid so, over their number when they are spaced for the shallowest depth, on a plane that deepens across the
/// survey from `shallow_m` to `deep_m`: the limit of narrow swaths, d1 ln(d2 / d1) / (d2 - d1). 1 on level ground.
/// Both > 0.
double adaptive_share(double shallow_m, double deep_m);

}  // namespace ensonify::survey
