#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "components/navigation/testing/circle.h"
#include "components/runtime/testing/node_under_test.h"
#include "messages/terrain.h"

using namespace ensonify;
using Catch::WithinAbs;
constexpr double kPi = std::numbers::pi;

namespace {

NavigationConfig config_of(double scale) {
  NavigationConfig config;
  config.process = "nav";
  config.origin = frames::Geodetic{44.0, -63.0};
  config.heights.rest_m = -2.0;
  NavigationErrors& s = config.sigma;
  for (double* sigma :
       {&s.roll_rad, &s.pitch_rad, &s.heading_rad, &s.heave_m, &s.horizontal_m, &s.vertical_m, &s.velocity_mps}) {
    *sigma *= scale;
  }
  return config;
}

/// North at 2 m/s, heaving 0.3 m in 5 s about 2 m below datum, rolled 5 degrees.
msg::Pose truth_at(SimTime t) {
  const double w = 2 * kPi / 5.0;
  msg::Pose pose;
  pose.stamp_ns = t.count();
  pose.position_enu_m = {10.0, 2.0 * seconds(t), -2.0 + 0.3 * std::sin(w * seconds(t))};
  pose.velocity_enu_mps = {0.0, 2.0, 0.3 * w * std::cos(w * seconds(t))};
  pose.enu_from_body = frames::wxyz_of(frames::enu_from_body(frames::Attitude{0.5, 0.0, 5 * kPi / 180}));
  return pose;
}

void give_truth(NodeUnderTest<NavigationNode>& navigation, int seconds_long) {
  navigation.give_each("pose", seconds_long * 1_s, 10_ms, &truth_at);
}

struct Moments {
  double sum = 0, squares = 0;
  int n = 0;
  void add(double x) { sum += x, squares += x * x, ++n; }
  double mean() const { return sum / n; }
  double sigma() const { return std::sqrt(squares / n - mean() * mean()); }
};

}  // namespace

TEST_CASE("attitude comes at 100 Hz, position at 5 Hz, an estimate with each attitude") {
  NodeUnderTest<NavigationNode> navigation(config_of(1));
  give_truth(navigation, 2);
  navigation.run_until(2_s);
  CHECK(navigation.take("attitude").size() == 201);
  CHECK(navigation.take("position").size() == 11);
  CHECK(navigation.take("estimate").size() == 201);
}

TEST_CASE("without noise the instruments report the truth") {
  NodeUnderTest<NavigationNode> navigation(config_of(0));
  give_truth(navigation, 10);
  const auto estimates = navigation.step_until<msg::Estimate>("estimate", 10_s);
  const auto attitudes = navigation.step_until<msg::Attitude>("attitude", 10_s);
  const auto positions = navigation.step_until<msg::Position>("position", 10_s);
  CHECK(attitudes[125].roll_rad == Approx(5 * kPi / 180));
  CHECK(attitudes[125].heading_grid_rad == Approx(0.5));
  CHECK(attitudes[125].heave_m == Approx(0.3));
  const frames::LocalProjection world({44.0, -63.0});
  const auto place = world.enu_of({positions[20].latitude_deg, positions[20].longitude_deg});
  CHECK((place - frames::Vec2(10.0, 2.0 * 4.0)).norm() < 1e-6);
  for (std::size_t i = 0; i < estimates.size(); i += 7) {
    const msg::Pose truth = truth_at(SimTime{estimates[i].stamp_ns});
    // Trapezoids follow a sine of 0.3 m and 5 s within w^2 h^2 / 12 of its height.
    for (std::size_t k = 0; k < 3; ++k) {
      REQUIRE_THAT(estimates[i].position_enu_m[k], WithinAbs(truth.position_enu_m[k], 1e-5));
    }
    REQUIRE(estimates[i].enu_from_body[0] == Approx(truth.enu_from_body[0]));
  }
}

TEST_CASE("noise has the stated sigma and no mean, and depends on seed and process") {
  NodeUnderTest<NavigationNode> navigation(config_of(1));
  give_truth(navigation, 100);
  navigation.run_until(100_s);
  Moments roll, heading, heave;
  for (const auto& a : navigation.step_until<msg::Attitude>("attitude", 100_s)) {
    roll.add(a.roll_rad - 5 * kPi / 180);
    heading.add(a.heading_grid_rad - 0.5);
    heave.add(a.heave_m - (truth_at(SimTime{a.stamp_ns}).position_enu_m[2] + 2.0));
  }
  const NavigationErrors sigma;
  // 10001 samples: a mean strays by sigma / 100, a sigma by sigma / 141; four times that is allowed.
  CHECK_THAT(roll.mean(), WithinAbs(0, 0.04 * sigma.roll_rad));
  CHECK(roll.sigma() == Approx(sigma.roll_rad).epsilon(0.03));
  CHECK(heading.sigma() == Approx(sigma.heading_rad).epsilon(0.03));
  CHECK(heave.sigma() == Approx(sigma.heave_m).epsilon(0.03));
  Moments east;
  for (const auto& p : navigation.step_until<msg::Position>("position", 100_s)) east.add(p.position_enu_m[0] - 10);
  CHECK(east.sigma() == Approx(sigma.horizontal_m).epsilon(0.13));  // 501 samples

  const auto first_roll = [](NavigationConfig config) {
    NodeUnderTest<NavigationNode> other(config);
    other.give("pose", truth_at(0_s));
    return other.step_until<msg::Attitude>("attitude", 0_s).at(0).roll_rad;
  };
  NavigationConfig other_seed = config_of(1), other_process = config_of(1);
  other_seed.seed = 2;
  other_process.process = "nav2";
  CHECK(first_roll(config_of(1)) == first_roll(config_of(1)));
  CHECK(first_roll(config_of(1)) != first_roll(other_seed));
  CHECK(first_roll(config_of(1)) != first_roll(other_process));
}

TEST_CASE("the estimate is quieter than the fixes by what the filter's theory says") {
  NavigationConfig config = config_of(1);
  config.sigma.velocity_mps = 0.0;
  NodeUnderTest<NavigationNode> navigation(config);
  give_truth(navigation, 400);
  Moments east;
  for (const auto& e : navigation.step_until<msg::Estimate>("estimate", 400_s)) {
    if (e.stamp_ns > 20'000'000'000) east.add(e.position_enu_m[0] - 10);
  }
  // 1900 fixes with a memory of about 2 / gain fixes are some 190 independent ones: sigma within 5 %, here 4 x that.
  CHECK(east.sigma() == Approx(config.sigma.horizontal_m * std::sqrt(0.2 / 1.8)).epsilon(0.2));
}

TEST_CASE("the probe reports sound speed at its depth, with bias, noise and latency") {
  NavigationConfig config = config_of(0);
  config.water.sound_speed = refraction::SoundSpeedProfile({{0.0, 1500.0}, {10.0, 1520.0}});  // 2 m/s per m
  config.probe.position_body_m = {0.0, 0.0, 1.0};
  config.probe.rate_hz = 2;
  config.probe.sigma_mps = 0.0;
  config.probe.bias_mps = 0.7;
  config.probe.latency_s = 0.25;
  NodeUnderTest<NavigationNode> navigation(config);
  give_truth(navigation, 100);
  const auto speeds = navigation.step_until<msg::SoundSpeed>("sound_speed", 1.3_s);
  REQUIRE(speeds.size() == 3);  // of 0, 0.5 and 1 s; that of 1 s came at 1.25 s
  CHECK(speeds[2].stamp_ns == 1'000'000'000);
  // 1 m below the body, which is rolled by 5 degrees.
  const double depth_m = -truth_at(1_s).position_enu_m[2] + std::cos(5 * kPi / 180);
  CHECK(speeds[2].sound_speed_mps == Approx(1500.0 + 2.0 * depth_m + 0.7).epsilon(1e-12));
  CHECK(navigation.step_until<msg::SoundSpeed>("sound_speed", 1.74_s).empty());
  CHECK(navigation.step_until<msg::SoundSpeed>("sound_speed", 1.75_s).size() == 1);

  config.probe = SoundSpeedProbe{};
  config.probe.rate_hz = 10;
  config.water.sound_speed = refraction::SoundSpeedProfile::uniform(1490.0);
  NodeUnderTest<NavigationNode> noisy(config);
  give_truth(noisy, 100);
  Moments error;
  for (const auto& s : noisy.step_until<msg::SoundSpeed>("sound_speed", 100_s)) error.add(s.sound_speed_mps - 1490.0);
  // 1001 samples: the mean strays by sigma / 32, sigma by 2.2 %; four times that is allowed.
  CHECK(error.n == 1001);
  CHECK_THAT(error.mean(), WithinAbs(0, config.probe.sigma_mps / 8));
  CHECK(error.sigma() == Approx(config.probe.sigma_mps).epsilon(0.09));
}

TEST_CASE("an origin left to the raster comes with the chart; nothing is measured before") {
  NavigationConfig config = config_of(0);
  config.origin.reset();
  NodeUnderTest<NavigationNode> navigation(config);
  msg::Chart chart;
  chart.origin_latitude_deg = 10.0;
  chart.origin_longitude_deg = 20.0;
  navigation.give_at("chart", 1_s, chart);
  give_truth(navigation, 2);
  const auto positions = navigation.step_until<msg::Position>("position", 2_s);
  REQUIRE(positions.size() == 6);
  CHECK(positions[0].stamp_ns == 1'000'000'000);
  CHECK_THAT(positions[0].latitude_deg, WithinAbs(10.0, 1e-4));
}

TEST_CASE("position latency delays the estimate's east and north, and nothing else") {
  NavigationConfig late = config_of(0);
  late.position_latency_s = 0.155;  // between two estimates
  const auto last_of = [](const NavigationConfig& config) {
    NodeUnderTest<NavigationNode> navigation(config);
    give_truth(navigation, 3);
    return navigation.step_until<msg::Estimate>("estimate", 2_s).back();
  };
  const msg::Estimate old = last_of(late), now = last_of(config_of(0));
  CHECK(old.stamp_ns == now.stamp_ns);
  CHECK_THAT(now.position_enu_m[1] - old.position_enu_m[1], WithinAbs(2.0 * 0.155, 1e-6));  // north at 2 m/s
  CHECK(old.position_enu_m[2] == now.position_enu_m[2]);
  CHECK(old.enu_from_body == now.enu_from_body);
}

TEST_CASE("motion sensor latency delays attitude and heave, not the position fixes") {
  // A sixth of the heave's 5 s. The roll turns with time: 2 degrees per second.
  NavigationConfig config = config_of(0);
  config.motion_latency_s = 5.0 / 6.0;
  NodeUnderTest<NavigationNode> navigation(config);
  for (int i = 0; i <= 300; ++i) {
    msg::Pose pose = truth_at(i * 10_ms);
    pose.enu_from_body = frames::wxyz_of(frames::enu_from_body(frames::Attitude{0.5, 0.0, 2 * kPi / 180 * 0.01 * i}));
    navigation.give("pose", pose);
  }
  const auto attitudes = navigation.step_until<msg::Attitude>("attitude", 2_s);
  const auto positions = navigation.step_until<msg::Position>("position", 2_s);
  const msg::Attitude& last = attitudes.back();
  CHECK(last.stamp_ns == (2_s).count());
  // Poses come every 10 ms: the newest that is old enough is 0.84 s old.
  CHECK_THAT(last.roll_rad, WithinAbs(2 * kPi / 180 * (2.0 - 0.84), 1e-9));
  CHECK_THAT(last.heave_m, WithinAbs(0.3 * std::sin(2 * kPi / 5.0 * (2.0 - 0.84)), 1e-9));
  CHECK_THAT(attitudes.front().roll_rad, WithinAbs(0.0, 1e-9));  // before, the oldest there is
  CHECK(positions.back().position_enu_m[1] == Approx(4.0));
}
