#include <catch2/catch.hpp>
#include <cmath>

#include "components/runtime/testing/node_under_test.h"
#include "components/towed_body/node.h"

using namespace ensonify;
using Catch::WithinAbs;

namespace {

constexpr double kSpeed_mps = 2.0;

World sea() {
  World world;
  world.vehicles = {{"fish"}};
  return world;
}

TowedBodyConfig config_of(const std::string& yaml) {
  ConfigReader from = ConfigReader::from_text(yaml, "fish.yaml");
  const auto config = TowedBodyConfig::read(from, sea(), "fish");
  from.finish();
  return config;
}

/// A short cable, sheave over the stern at the water level: 40 m.
const std::string kShort = "cable: { out_m: 40 }\nsheave_m: [0, 0, 0]\ndepth_lag_s: 5\n";
const std::string kQuiet = "positioning: { depth_white_m: 0, heading_white_deg: 0, level_white_deg: 0 }\n";

/// Northwards, then from `turn_s` on in a circle of 60 m to starboard.
msg::Pose vessel_at(double t_s, double turn_s) {
  constexpr double kRadius_m = 60.0;
  const double turned = std::max(0.0, t_s - turn_s) * kSpeed_mps / kRadius_m,
               straight_m = kSpeed_mps * std::min(t_s, turn_s);
  msg::Pose pose;
  pose.stamp_ns = from_seconds(t_s).count();
  pose.position_enu_m = {kRadius_m * (1.0 - std::cos(turned)), straight_m + kRadius_m * std::sin(turned), 0.0};
  pose.velocity_enu_mps = {kSpeed_mps * std::sin(turned), kSpeed_mps * std::cos(turned), 0.0};
  pose.enu_from_body = frames::wxyz_of(frames::enu_from_body({turned, 0.0, 0.0}));
  return pose;
}

msg::Estimate known(const msg::Pose& pose) {
  msg::Estimate estimate;
  estimate.stamp_ns = pose.stamp_ns;
  estimate.position_enu_m = pose.position_enu_m;
  estimate.enu_from_body = pose.enu_from_body;
  estimate.velocity_enu_mps = pose.velocity_enu_mps;
  return estimate;
}

struct Towed {
  std::vector<msg::Pose> poses;
  std::vector<msg::Estimate> estimates;
};

Towed run(const std::string& yaml, double until_s, double turn_s = 1e9) {
  NodeUnderTest<TowedBodyNode> fish(config_of(yaml));
  for (int i = 0; i * 0.02 <= until_s; ++i) {
    const msg::Pose pose = vessel_at(i * 0.02, turn_s);
    fish.give("vessel", pose);
    fish.give("vessel_estimate", known(pose));
  }
  const auto poses = fish.step_until<msg::Pose>("pose", from_seconds(until_s));
  return {poses, fish.step_until<msg::Estimate>("estimate", from_seconds(until_s))};
}

double across_m(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1]);
}

}  // namespace

TEST_CASE("on a straight course the body runs at the cable's end, its motion the derivative") {
  const Towed towed = run(kShort + kQuiet, 20);
  REQUIRE(towed.poses.size() == 1001);
  const auto shape = motion::tow_shape(config_of(kShort).cable, config_of(kShort).body, kSpeed_mps);
  for (std::size_t i = 100; i < towed.poses.size(); i += 100) {
    const msg::Pose& pose = towed.poses[i];
    const double t_s = static_cast<double>(pose.stamp_ns) * 1e-9;
    REQUIRE_THAT(pose.position_enu_m[0], WithinAbs(0.0, 1e-9));
    REQUIRE_THAT(pose.position_enu_m[1], WithinAbs(kSpeed_mps * t_s - shape.layback_m, 1e-3));
    REQUIRE_THAT(pose.position_enu_m[2], WithinAbs(-shape.depth_m, 1e-3));
    REQUIRE_THAT(pose.velocity_enu_mps[1], WithinAbs(kSpeed_mps, 1e-6));
  }
}

TEST_CASE("in a circle it runs inside the vessel's track and deeper, as layback errs") {
  const Towed towed = run(kShort + kQuiet, 220, 20);
  const msg::Pose& pose = towed.poses.back();
  const double radius_m = std::hypot(pose.position_enu_m[0] - 60.0, pose.position_enu_m[1] - 40.0);
  const double speed_mps = std::hypot(pose.velocity_enu_mps[0], pose.velocity_enu_mps[1]);
  const auto shape = motion::tow_shape(config_of(kShort).cable, config_of(kShort).body, speed_mps);
  CHECK(radius_m == Approx(std::sqrt(60.0 * 60.0 - shape.layback_m * shape.layback_m)).epsilon(0.002));
  CHECK(speed_mps == Approx(kSpeed_mps * radius_m / 60.0).epsilon(0.002));
  CHECK(-pose.position_enu_m[2] == Approx(shape.depth_m).epsilon(0.002));
  CHECK(shape.depth_m > motion::tow_shape(config_of(kShort).cable, config_of(kShort).body, kSpeed_mps).depth_m + 0.5);

  const msg::Estimate& estimated = towed.estimates.back();
  const double estimated_m = std::hypot(estimated.position_enu_m[0] - 60.0, estimated.position_enu_m[1] - 40.0);
  CHECK_THAT(estimated_m, WithinAbs(60.0, 0.01));  // chords of a metre
  CHECK(across_m(estimated.position_enu_m, pose.position_enu_m) > 60.0 - radius_m - 0.01);
}

TEST_CASE("layback is that of a straight cable, or a set share, by a counter with error") {
  const auto off_m = [](const std::string& positioning) {
    const Towed towed = run(kShort + "positioning: { depth_white_m: 0, " + positioning + " }\n", 10);
    return 2.0 * 10.0 - towed.estimates.back().position_enu_m[1];
  };
  const double depth_m = motion::tow_shape(config_of(kShort).cable, config_of(kShort).body, kSpeed_mps).depth_m;
  const double straight_m = std::sqrt(40.0 * 40.0 - depth_m * depth_m);
  CHECK_THAT(off_m("layback_factor: 1"), WithinAbs(straight_m, 0.01));
  CHECK_THAT(off_m("layback_factor: 0.9"), WithinAbs(0.9 * straight_m, 0.01));
  CHECK_THAT(off_m("cable_scale: 0.05"), WithinAbs(std::sqrt(42.0 * 42.0 - depth_m * depth_m), 0.01));
  const double true_m = motion::tow_shape(config_of(kShort).cable, config_of(kShort).body, kSpeed_mps).layback_m;
  CHECK(straight_m > true_m);  // a cable sags: the straight one is too long
}

TEST_CASE("by USBL the estimate follows fixes, late ones corrected; none before the first") {
  NodeUnderTest<TowedBodyNode> fish(
      config_of(kShort + "positioning: { by: usbl, heading_white_deg: 0, usbl_gain: 0.3 }\n"));
  double worst_m = 0.0;
  std::size_t reported = 0;
  const random::Stream noise(3, "test");
  for (int i = 0; i <= 60 * 50; ++i) {
    const double t_s = i * 0.02;
    const msg::Pose vessel = vessel_at(t_s, 1e9);
    fish.give("vessel", vessel);
    fish.give("vessel_estimate", known(vessel));
    const auto poses = fish.step_until<msg::Pose>("pose", from_seconds(t_s));
    const auto estimates = fish.step_until<msg::Estimate>("estimate", from_seconds(t_s));
    if (t_s < 5.0) CHECK(estimates.empty());
    if (i % 50 == 0 && t_s >= 5.0) {  // a fix of half a second ago, 1 m off by chance
      msg::UsblFix fix;
      fix.stamp_ns = poses.back().stamp_ns - 500'000'000;
      fix.valid = true;
      fix.position_enu_m = poses.back().position_enu_m;
      fix.position_enu_m[1] -= 0.5 * kSpeed_mps;
      for (std::uint32_t axis = 0; axis < 2; ++axis) {
        fix.position_enu_m[axis] += noise.normal(static_cast<std::uint64_t>(i), axis);
      }
      fix.sigma_enu_m = {1, 1, 1};
      fish.give_at("usbl", from_seconds(t_s), fix);
    }
    if (t_s < 20.0 || estimates.empty()) continue;
    ++reported;
    worst_m = std::max(worst_m, across_m(estimates.back().position_enu_m, poses.back().position_enu_m));
    REQUIRE(estimates.back().position_covariance_enu_m2[0] == Approx(1.0));
  }
  CHECK(reported > 1900);
  // A gain g leaves sqrt(g / (2 - g)) = 0.42 of a fix's noise; of 40 fixes of two axes the largest is about 3 of those.
  CHECK(worst_m < 4 * 0.42);
  CHECK(worst_m > 0.42);
}

TEST_CASE("impossible bodies are refused") {
  CHECK_THROWS_WITH(config_of("cable: { out_m: -3 }"), Catch::Contains("cable.out_m: -3 is outside [1, 10000]"));
  CHECK_THROWS_WITH(config_of("body: { weight_n: .nan }"), Catch::Contains("body.weight_n"));
  CHECK_THROWS_WITH(config_of("positioning: { by: dowsing }"), Catch::Contains("not one of layback, usbl"));
}
