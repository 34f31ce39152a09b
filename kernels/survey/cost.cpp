#include "kernels/survey/cost.h"

#include <stdexcept>

#include "kernels/vehicle/runlines/turn.h"

namespace ensonify::survey {

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

}  // namespace ensonify::survey
