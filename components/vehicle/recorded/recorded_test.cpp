#include "components/vehicle/recorded/recorded.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "components/runtime/testing/node_under_test.h"
#include "components/vehicle/node.h"
#include "components/vehicle/testing/integrated.h"
#include "kernels/base/frames/attitude.h"

using namespace ensonify;
using Catch::WithinAbs;

namespace {

/// Thirty seconds north at 2 m/s, in 1 Hz samples, with a roll of 8 s and a heave of 0.2 m.
tracks::Track recorded() {
  tracks::Track track;
  track.file = "track.csv";
  for (int i = 0; i <= 30; ++i) {
    const std::int64_t ns = i * std::int64_t{1'000'000'000};
    track.spots.push_back({ns, {0, 2.0 * i}});
    track.roll_rad.push_back({ns, 0.1 * std::sin(2.0 * M_PI * i / 8.0)});
    track.heave_m.push_back({ns, 0.2});
  }
  return track;
}

VehicleConfig following(const FollowTrack& wanted = {}) {
  VehicleConfig config;
  config.followed = std::make_shared<const tracks::FollowedTrack>(recorded(), wanted, std::nullopt, 10.0);
  config.start = motion::State{};
  config.water.tide = vertical::Tide(1.5);
  config.plan.mission.depth_m = 4.0;
  return config;
}

frames::Attitude attitude(const msg::Pose& pose) {
  return frames::attitude_of(frames::quaternion_of(pose.enu_from_body));
}

}  // namespace

TEST_CASE("a vehicle that follows is at the track's places, at the mission's depth below the water, with its heave") {
  NodeUnderTest<VehicleNode> vehicle(following());
  const auto poses = vehicle.step_until<msg::Pose>("pose", 30_s);
  REQUIRE(poses.size() == 3001);
  for (std::size_t i = 0; i < poses.size(); i += 100)
    REQUIRE_THAT(poses[i].position_enu_m[1], WithinAbs(0.02 * static_cast<double>(i), 1e-9));
  CHECK_THAT(poses[500].position_enu_m[2], WithinAbs(1.5 - 4.0 + 0.2, 1e-9));
  CHECK_THAT(attitude(poses[200]).roll_rad, WithinAbs(0.1, 1e-9));
  CHECK_THAT(poses[500].velocity_enu_mps[1], WithinAbs(2.0, 1e-9));
}

TEST_CASE("a boat that floats rides the tide and settles by its speed through the water") {
  VehicleConfig config = following();
  config.water.floats = vertical::Loading{.settlement = {{0.0, 0.0}, {3.0, 0.3}}};
  config.water.current = motion::Current{};
  NodeUnderTest<VehicleNode> vehicle(config);
  const auto poses = vehicle.step_until<msg::Pose>("pose", 20_s);
  CHECK_THAT(poses[1500].position_enu_m[2], WithinAbs(1.5 - 0.2 + 0.2, 1e-6));
}

TEST_CASE("recorded motion has no waves added; a modelled one has them, and the recorded places") {
  VehicleConfig config = following();
  config.waves.roll_rad = {0.3, 5.0, 0.7};
  config.waves.heave_m = {0.5, 4.0, 0.0};
  NodeUnderTest<VehicleNode> plain(config);
  const auto as_recorded = plain.step_until<msg::Pose>("pose", 10_s);
  CHECK_THAT(attitude(as_recorded[200]).roll_rad, WithinAbs(0.1, 1e-9));

  VehicleConfig modelled = following({.attitude = FollowTrack::Attitude::kModelled});
  modelled.waves = config.waves;
  modelled.disturbance = *motion::disturbance_preset("survey_launch");
  NodeUnderTest<VehicleNode> rolling(modelled);
  const auto poses = rolling.step_until<msg::Pose>("pose", 10_s);
  double most_rad = 0.0;
  for (const msg::Pose& pose : poses) most_rad = std::max(most_rad, std::abs(attitude(pose).roll_rad));
  CHECK(most_rad > 0.25);
  for (std::size_t i = 0; i < poses.size(); i += 100) {
    CHECK_THAT(poses[i].position_enu_m[0], WithinAbs(0.0, 1e-9));
    CHECK_THAT(poses[i].position_enu_m[1], WithinAbs(0.02 * static_cast<double>(i), 1e-9));
  }
}

TEST_CASE("a pose is where the velocity of the one before says, within 2 cm and 0.05 degrees") {
  NodeUnderTest<VehicleNode> vehicle(following());
  const auto poses = vehicle.step_until<msg::Pose>("pose", 30_s);
  for (std::size_t i = 1; i + 1 < poses.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double predicted_m = poses[i - 1].position_enu_m[k] + 0.01 * poses[i - 1].velocity_enu_mps[k];
      REQUIRE_THAT(poses[i].position_enu_m[k], WithinAbs(predicted_m, 0.02));
    }
    const double predicted_rad = attitude(poses[i - 1]).roll_rad + 0.01 * poses[i - 1].rate_body_radps[0];
    REQUIRE_THAT(attitude(poses[i]).roll_rad, WithinAbs(predicted_rad, 0.05 * M_PI / 180.0));
  }
}
