#include <catch2/catch.hpp>

#include "components/navigation/testing/circle.h"

using namespace ensonify;
using namespace ensonify::test_run;

// The filter of a vehicle under water: its log sees water alone, a ship reports where she found it.

namespace {

constexpr auto kDeep = [](double) { return -40.0; };

NavigationConfig under_water(const std::string& yaml, std::uint64_t seed = 1) {
  NavigationConfig config = config_of(
      "imu: { grade: tactical, alignment: { position_m: 0, height_m: 0.1, velocity_mps: 0.1, tilt_deg: 0.05, "
      "heading_deg: 0.3 } }\ndepth: { grade: quartz }\n" +
          yaml,
      seed);
  config.heights.current.profile = {{0.0, {0.25, -0.2}}};
  return config;
}

frames::Vec3 vec(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

struct Off {
  double level_m, sigma_m;  // error, and the standard deviation that is stated of it
};
Off off(const msg::Estimate& estimate) {
  const msg::Pose truth = circling(SimTime{estimate.stamp_ns}, kDeep);
  const auto& p = estimate.position_covariance_enu_m2;
  return {(vec(estimate.position_enu_m) - vec(truth.position_enu_m)).head<2>().norm(), std::sqrt(p[0] + p[4])};
}

/// Where the vehicle was `age` before, as a ship 50 m east of the circle's middle says that comes now.
void give_fix(NodeUnderTest<NavigationNode>& navigation, SimTime now, SimTime age) {
  const msg::Pose then = circling(now - age, kDeep);
  msg::UsblFix fix;
  fix.stamp_ns = then.stamp_ns;
  fix.valid = true;
  fix.position_enu_m = then.position_enu_m;
  fix.place_body_m = {then.position_enu_m[1], then.position_enu_m[0] - 150.0, -then.position_enu_m[2]};
  fix.range_m = vec(fix.place_body_m).norm();
  fix.sigma_enu_m = {0.2, 0.2, 0.2};
  navigation.give_at("usbl_fix", now, fix);
}

}  // namespace

TEST_CASE("tracking water holds a vehicle that has no bottom to what the current may be") {
  // A minute at 2 m/s. The current displaces by 0.32 m/s x 60 s = 19 m; a unit of this grade alone drifts by more than
  // 2 m/s^2 x 1e-3 x 60^2 / 2, and says so.
  const auto after_a_minute = [](const std::string& log) {
    NodeUnderTest<NavigationNode> navigation(under_water(log));
    run_for(navigation, 60, kDeep);
    return off(navigation.step_until<msg::Estimate>("estimate", 60_s).back());
  };
  const Off water = after_a_minute("velocity_log: { grade: performance, water_track_m: 3 }");
  const Off nothing = after_a_minute("velocity_log: { grade: performance }");
  CHECK(water.level_m < 25.0);
  CHECK(water.level_m < 3.0 * water.sigma_m);
  CHECK(water.sigma_m < 30.0);  // sqrt(2) x 0.3 m/s x 60 s, if the unit reported nothing
  CHECK(nothing.sigma_m > water.sigma_m);
}

TEST_CASE("fixes of a ship, a second and a half old, hold a vehicle where it is") {
  NodeUnderTest<NavigationNode> navigation(
      under_water("velocity_log: { grade: performance, water_track_m: 3 }\nusbl_fixes: { place_m: 0.1 }"));
  for (SimTime now = 2_s; now <= 60_s; now = now + 2_s) give_fix(navigation, now, 1'500_ms);
  run_for(navigation, 60, kDeep);
  const auto estimates = navigation.step_until<msg::Estimate>("estimate", 60_s);
  // The vehicle goes 3 m in 1.5 s. Thirty fixes of 0.2 m and the speed of the water.
  const Off last = off(estimates.back());
  CHECK(last.level_m < 0.5);
  CHECK(last.sigma_m < 0.6);
  CHECK(last.level_m < 4.0 * last.sigma_m);
}

TEST_CASE("an invalid fix and an implausible one change no estimate") {
  const auto end_of = [](const auto& give) {
    NodeUnderTest<NavigationNode> navigation(under_water("usbl_fixes: {}"));
    give(navigation);
    run_for(navigation, 10, kDeep);
    return navigation.step_until<msg::Estimate>("estimate", 10_s).back().position_enu_m;
  };
  const auto unreported = end_of([](NodeUnderTest<NavigationNode>&) {});
  msg::UsblFix fix;
  fix.stamp_ns = (4_s).count();
  CHECK(end_of([&](NodeUnderTest<NavigationNode>& n) { n.give_at("usbl_fix", 5_s, fix); }) == unreported);
  fix.valid = true;
  fix.position_enu_m = {1000.0, 0.0, -40.0};
  fix.sigma_enu_m = {0.2, 0.2, 0.2};
  CHECK(end_of([&](NodeUnderTest<NavigationNode>& n) { n.give_at("usbl_fix", 5_s, fix); }) == unreported);
}

TEST_CASE("fixes by a ship need an inertial unit") {
  ConfigReader from = ConfigReader::from_text("usbl_fixes: { place_m: 0.1 }", "nav.yaml");
  NavigationParameters::read(from);
  CHECK_THROWS_WITH(from.finish(),
                    Catch::Contains("usbl_fixes: they correct the filter of an inertial unit: list imu too"));
}
