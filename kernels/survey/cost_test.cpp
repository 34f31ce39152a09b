#include <catch2/catch.hpp>
#include <numbers>
#include <vector>

#include "kernels/survey/spacing.h"

using namespace ensonify;
using namespace ensonify::survey;

TEST_CASE("a lawnmower two radii wide turns in half circles; time, data and cost follow") {
  const auto lines = runlines::lawnmower({0, 0}, 0.3, 500.0, 40.0, 4);
  RunRules rules;
  rules.speed_mps = 4.0;
  rules.turn_speed_mps = 2.0;
  rules.turning_radius_m = 20.0;
  rules.data_bytes_per_s = 1e6;
  rules.cost_per_day = 8640.0;
  RunCost cost = run_cost(lines, rules);
  CHECK(cost.line_m == Approx(2000.0));
  CHECK(cost.turn_m == Approx(3 * std::numbers::pi * 20.0));
  CHECK(cost.line_s == Approx(500.0));
  CHECK(cost.turn_s == Approx(cost.turn_m / 2.0));
  CHECK(cost.data_bytes == Approx(500e6));
  CHECK(cost.cost == Approx(0.1 * cost.total_s));

  rules.run_in_m = rules.run_out_m = 30.0;  // the half circles move out by 30 m, all lines are longer by 60 m
  rules.record_in_turns = true;
  cost = run_cost(lines, rules);
  CHECK(cost.turn_m == Approx(3 * std::numbers::pi * 20.0));
  CHECK(cost.turn_s == Approx(cost.turn_m / 2.0 + 4 * 60.0 / 4.0));
  CHECK(cost.data_bytes == Approx(1e6 * cost.total_s));
}

TEST_CASE("lines closer than two radii take the longer way that the circle leaves") {
  const auto lines = runlines::lawnmower({0, 0}, 0.0, 500.0, 20.0, 2);
  RunRules rules;
  rules.turning_radius_m = 20.0;
  // Three arcs: out by a, round by pi + 2 a, back by a, with cos a = (2 r + s) / (4 r), s the spacing.
  const double a = std::acos((2 * 20.0 + 20.0) / (4 * 20.0));
  CHECK(run_cost(lines, rules).turn_m == Approx(20.0 * (std::numbers::pi + 4 * a)));
}

TEST_CASE("redundancy is the area swept over the area") {
  const auto lines = runlines::lawnmower({0, 0}, 0.0, 100.0, 30.0, 2);
  CHECK(redundancy(lines, std::vector<double>{40.0, 40.0}, 100.0 * 60.0) == Approx(80.0 / 60.0));
  CHECK_THROWS_AS(redundancy(lines, std::vector<double>{40.0}, 1.0), std::invalid_argument);
}
