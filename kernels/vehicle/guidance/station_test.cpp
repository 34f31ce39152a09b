#include <catch2/catch.hpp>
#include <cmath>

#include "kernels/vehicle/guidance/laws.h"
#include "kernels/vehicle/motion/kinematics.h"

using namespace ensonify;
using namespace ensonify::guidance;
using Catch::WithinAbs;

TEST_CASE("at the stopping speed a vehicle stops within d = v^2 / (2 a) + v lag") {
  for (const double d : {0.0, 0.5, 10.0, 400.0}) {
    const double v = stopping_speed_mps(d, 0.2, 0.5);
    CHECK_THAT(v * v / 0.4 + 0.5 * v, WithinAbs(d, 1e-9));
  }
  CHECK(stopping_speed_mps(10.0, 0.2, 0.0) == Approx(2.0));
}

namespace {

struct Kept {
  double farthest_m = 0.0;   // after the first 300 s
  double overshoot_m = 0.0;  // beyond the place along the first approach
};

/// A kinematic vehicle that comes from the south at 2 m/s and keeps its place for 900 s; commands 10 times a second.
Kept keep(const StationRules& rules, const Vec2& current) {
  motion::Limits limits;
  limits.turning_radius_m = 8.0;
  motion::State state{{0, -100, 0}, 0.0, 2.0, 0.0};
  Kept kept;
  for (int i = 0; i < 9000; ++i) {
    const Steering order = keep_station(rules, {0, 0}, state.position_enu_m.head<2>(), state.heading_rad, current);
    state = motion::advance(state, {order.heading_rad, order.speed_mps, 0.0}, 0.1, limits);
    state.position_enu_m.head<2>() += 0.1 * current;
    if (i < 1500) kept.overshoot_m = std::max(kept.overshoot_m, state.position_enu_m.y());
    if (i > 3000) kept.farthest_m = std::max(kept.farthest_m, state.position_enu_m.head<2>().norm());
  }
  return kept;
}

}  // namespace

TEST_CASE("a vehicle stops at its place without going beyond it, and stays in still water") {
  StationRules rules;
  const Kept kept = keep(rules, {0, 0});
  CHECK(kept.overshoot_m <= 0.0);
  CHECK(kept.farthest_m <= rules.watch_radius_m + 0.2);
}

TEST_CASE("in a current the place is kept with the bow upstream") {
  StationRules rules;
  for (const Vec2& current : {Vec2(0.5, 0.0), Vec2(-0.2, 0.3), Vec2(0.0, -0.6)}) {
    CHECK(keep(rules, current).farthest_m < rules.watch_radius_m + 0.5);
  }
  const Steering order = keep_station(rules, {0, 0}, {0, 0}, 4.0, {0.5, 0.0});
  CHECK(order.heading_rad == Approx(1.5 * 3.14159265));
  CHECK(order.speed_mps == Approx(0.5));
}

TEST_CASE("a run upstream begins as far downstream as lining up and stopping take") {
  const auto way = upstream_way({3.0, 0.2, 2.0, 0.2, 0.5}, 30.0, {10, 20}, {0.3, 0.0});
  CHECK((way.start_enu_m - Vec2(10 + 11 + 30, 20)).norm() < 1e-9);  // v^2 / (2 a) + v lag = 11 m
  CHECK(way.end_enu_m == Vec2(10, 20));
}

TEST_CASE("from anywhere a vehicle comes upstream to its station without overshoot") {
  const StationRules rules{3.0, 0.2, 2.0, 0.2, 0.5};
  const Vec2 current(0.0, -0.5);  // upstream is north
  for (const double off_m : {0.0, 5.0, -20.0}) {
    motion::State state{{off_m, -80, 0}, 0.3, 2.0, 0.0};
    double overshoot_m = -INFINITY;
    for (int i = 0; i < 6000; ++i) {
      const Vec2 place = state.position_enu_m.head<2>();
      const Steering order = stem(rules, 15.0, upstream_way(rules, 30.0, {0, 0}, current), place, current);
      state = motion::advance(state, {order.heading_rad, order.speed_mps, 0.0}, 0.1, {});
      state.position_enu_m.head<2>() += 0.1 * current;
      overshoot_m = std::max(overshoot_m, state.position_enu_m.y());
    }
    CHECK(overshoot_m < 0.05);
    CHECK(state.position_enu_m.head<2>().norm() < 0.05);
  }
}

TEST_CASE("without a task heading stays; a bow pointing away turns at half speed at most") {
  const StationRules rules;
  CHECK(keep_station(rules, {0, 0}, {1, 0}, 4.0, {0, 0}).heading_rad == 4.0);
  CHECK(keep_station(rules, {0, 0}, {1, 0}, 4.0, {0, 0}).speed_mps == 0.0);
  CHECK(keep_station(rules, {0, 0}, {0, 100}, 0.0, {0, 0}).speed_mps == Approx(0.5));
  CHECK(keep_station(rules, {0, 0}, {0, 100}, 3.0, {0, 0}).speed_mps == Approx(1.0));
}
