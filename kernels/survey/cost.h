#pragma once

#include <span>

#include "kernels/vehicle/runlines/runline.h"

namespace ensonify::survey {

/// Parameters of running lines, and their costs.
struct RunRules {
  double speed_mps = 2.0;       // over ground on lines, > 0
  double turn_speed_mps = 2.0;  // > 0
  double turning_radius_m = 10.0;
  double run_in_m = 0.0;   // before each line, at its speed
  double run_out_m = 0.0;  // behind it
  double data_bytes_per_s = 0.0;
  bool record_in_turns = false;
  double cost_per_day = 0.0;  // any currency, of 24 h
};

struct RunCost {
  double line_m = 0.0;  // on lines alone
  double turn_m = 0.0;  // between them, by the shortest ways of the turning circle
  double line_s = 0.0;
  double turn_s = 0.0;  // with run-in and run-out
  double total_s = 0.0;
  double data_bytes = 0.0;
  double cost = 0.0;
};

/// Time, way and cost of lines run one after the other, the first from its run-in on.
RunCost run_cost(std::span<const runlines::Runline> lines, const RunRules& rules);

/// Redundancy of the coverage: swath of each line times its length, over the area. 1 is no place twice, where all is
/// covered.
double redundancy(std::span<const runlines::Runline> lines, std::span<const double> swath_m, double area_m2);

}  // namespace ensonify::survey
