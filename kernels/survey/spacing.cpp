#include "kernels/survey/spacing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace ensonify::survey {

double reach_m(double depth_m, double deepening, double half_angle_rad) {
  const double tangent = std::tan(half_angle_rad), closing = 1.0 - deepening * tangent;
  return closing > 0.0 ? depth_m * tangent / closing : std::numeric_limits<double>::infinity();
}

double next_line_across_m(std::span<const CoveredEdge> rows, const Swath& swath, double far_edge_m) {
  if (rows.empty()) throw std::invalid_argument("next_line_across_m: no row; at least one is needed");
  const double reach = (1.0 - swath.overlap) * std::tan(swath.half_angle_rad);
  double next_m = std::numeric_limits<double>::infinity(), first_open_m = next_m;
  for (const CoveredEdge& row : rows) {
    next_m = std::min(next_m, row.across_m + reach * row.depth_m);
    first_open_m = std::min(first_open_m, row.across_m);
  }
  return next_m < far_edge_m ? next_m : 0.5 * (first_open_m + far_edge_m);
}

double adaptive_share(double shallow_m, double deep_m) {
  const double ratio = deep_m / shallow_m;
  return std::abs(ratio - 1.0) < 1e-9 ? 1.0 : std::log(ratio) / (ratio - 1.0);
}

}  // namespace ensonify::survey
