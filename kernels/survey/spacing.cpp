#include "kernels/survey/spacing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "kernels/vehicle/runlines/runline.h"

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

double ping_rate_hz(double range_m, double sound_speed_mps, double dead_s, double highest_hz) {
  return std::min(highest_hz, 1.0 / (2.0 * range_m / sound_speed_mps + dead_s));
}

double footprint_m(double depth_m, double along_width_rad) { return 2.0 * depth_m * std::tan(0.5 * along_width_rad); }

double fastest_for_feature_mps(double feature_m, double footprint_m, double rate_hz, int pings) {
  return (feature_m + footprint_m) * rate_hz / pings;
}

int soundings_across(double feature_m, double beam_spacing_m) {
  return static_cast<int>(std::floor(feature_m / beam_spacing_m + 1e-9));
}

RunCost run_cost(std::span<const runlines::Runline> lines, const RunRules& rules) {
  RunCost cost;
  double extra_m = 0.0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    cost.line_m += runlines::length_m(lines[i]);
    extra_m += rules.run_in_m + rules.run_out_m;
    if (i + 1 == lines.size()) break;
    const runlines::Waypose from{runlines::extended(lines[i], 0.0, rules.run_out_m).end_enu_m,
                                 runlines::heading_rad(lines[i])};
    const runlines::Waypose to{runlines::extended(lines[i + 1], rules.run_in_m, 0.0).start_enu_m,
                               runlines::heading_rad(lines[i + 1])};
    cost.turn_m += runlines::shortest_turn(from, to, rules.turning_radius_m).length_m();
  }
  cost.line_s = cost.line_m / rules.speed_mps;
  cost.turn_s = extra_m / rules.speed_mps + cost.turn_m / rules.turn_speed_mps;
  cost.total_s = cost.line_s + cost.turn_s;
  cost.data_bytes = rules.data_bytes_per_s * (rules.record_in_turns ? cost.total_s : cost.line_s);
  cost.cost = rules.cost_per_day * cost.total_s / 86400.0;
  return cost;
}

double redundancy(std::span<const runlines::Runline> lines, std::span<const double> swath_m, double area_m2) {
  if (lines.size() != swath_m.size()) throw std::invalid_argument("redundancy: give one swath for each line");
  double swept_m2 = 0.0;
  for (std::size_t i = 0; i < lines.size(); ++i) swept_m2 += swath_m[i] * runlines::length_m(lines[i]);
  return swept_m2 / area_m2;
}

SidescanSwath sidescan_swath(double altitude_m, double range_m, double nadir_half_angle_rad) {
  return {altitude_m * std::tan(nadir_half_angle_rad), std::sqrt(range_m * range_m - altitude_m * altitude_m),
          std::asin(altitude_m / range_m)};
}

double joining_spacing_m(const SidescanSwath& swath, double overlap) { return 2.0 * swath.far_m * (1.0 - overlap); }

double gap_filling_spacing_m(const SidescanSwath& swath, double overlap) {
  return (swath.far_m - swath.near_m) * (1.0 - overlap);
}

double towfish_altitude_m(double range_m, double share, double least_m) { return std::max(share * range_m, least_m); }

double shadow_m(double object_m, double altitude_m, double ground_range_m) {
  return object_m < altitude_m ? object_m * ground_range_m / (altitude_m - object_m)
                               : std::numeric_limits<double>::infinity();
}

}  // namespace ensonify::survey
