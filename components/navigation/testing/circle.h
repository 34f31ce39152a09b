#pragma once

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "components/config/config_reader.h"
#include "components/navigation/node.h"
#include "components/runtime/testing/node_under_test.h"

// What tests of instruments share: a configuration of a few sections, and a vehicle that moves in a circle.
namespace ensonify::test_run {

constexpr double kPi = std::numbers::pi;
constexpr double kDegree = kPi / 180.0;

inline NavigationConfig config_of(const std::string& yaml, std::uint64_t seed = 1) {
  ConfigReader from = ConfigReader::from_text(yaml, "nav.yaml");
  NavigationConfig config{NavigationParameters::read(from)};
  from.finish();
  config.process = "nav";
  config.seed = seed;
  config.origin = frames::Geodetic{44.0, -63.0};
  return config;
}

/// A circle of 100 m at 2 m/s, rolling 5 degrees in 6 s, at `height(t)`.
template <class Height>
msg::Pose circling(SimTime at, const Height& height) {
  const double t = seconds(at), turn = 2.0 / 100.0, heading = turn * t;
  const double roll = 5 * kDegree * std::sin(2 * kPi * t / 6),
               roll_rate = 5 * kDegree * 2 * kPi / 6 * std::cos(2 * kPi * t / 6);
  msg::Pose pose;
  pose.stamp_ns = at.count();
  pose.position_enu_m = {100.0 - 100.0 * std::cos(heading), 100.0 * std::sin(heading), height(t)};
  pose.velocity_enu_mps = {2.0 * std::sin(heading), 2.0 * std::cos(heading),
                           (height(t + 1e-3) - height(t - 1e-3)) / 2e-3};
  pose.enu_from_body = frames::wxyz_of(frames::enu_from_body(frames::Attitude{heading, 0.0, roll}));
  const frames::Vec3 rates = frames::body_rates_radps({heading, 0.0, roll}, {turn, 0.0, roll_rate});
  pose.rate_body_radps = {rates.x(), rates.y(), rates.z()};
  return pose;
}

inline constexpr auto kLevel = [](double) { return -1.0; };

template <class Height>
void run_for(NodeUnderTest<NavigationNode>& navigation, int seconds_long, const Height& height) {
  navigation.give_each("pose", seconds_long * 1_s, 10_ms, [&](SimTime t) { return circling(t, height); });
}

}  // namespace ensonify::test_run
