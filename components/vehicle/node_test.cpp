#include "components/vehicle/node.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "components/config/config_error.h"
#include "components/runtime/testing/node_under_test.h"

using namespace ensonify;
using Catch::WithinAbs;
constexpr double kPi = std::numbers::pi;

namespace {

VehicleConfig going_north() {
  VehicleConfig config;
  config.limits = {.acceleration_mps2 = 0.5, .deceleration_mps2 = 0.5, .turning_radius_m = 10, .vertical_speed_mps = 1};
  config.fastest_mps = 4.0;
  config.start = motion::State{{0, 0, -3}, 0.0, 2.0};
  return config;
}

msg::Guidance command(SimTime t, double heading_rad, double speed_mps) { return {t.count(), heading_rad, speed_mps}; }

msg::Chart flat_chart(double depth_m) {
  msg::Chart chart;
  chart.west_m = chart.south_m = -500;
  chart.east_m = chart.north_m = 500;
  chart.spacing_m = 10;
  chart.height_m = msg::Array<float>({101, 101});
  for (float& height : chart.height_m.flat()) height = static_cast<float>(-depth_m);
  return chart;
}

}  // namespace

TEST_CASE("without commands a vehicle goes straight on, with 100 poses a second from t = 0") {
  NodeUnderTest<VehicleNode> vehicle(going_north());
  const auto poses = vehicle.step_until<msg::Pose>("pose", 10_s);
  REQUIRE(poses.size() == 1001);
  CHECK(poses[0].stamp_ns == 0);
  CHECK(poses[1].stamp_ns == 10'000'000);
  CHECK(poses[1000].position_enu_m[1] == Approx(20.0));
  CHECK(poses[1000].position_enu_m[2] == Approx(-3.0));
  CHECK(poses[1000].velocity_enu_mps[1] == Approx(2.0));
}

TEST_CASE("a command takes effect 100 ms after it was given") {
  NodeUnderTest<VehicleNode> vehicle(going_north());
  vehicle.give("command", command(1_s, 0.0, 3.0));
  const auto poses = vehicle.step_until<msg::Pose>("pose", 2_s);
  CHECK(poses[110].velocity_enu_mps[1] == Approx(2.0));
  CHECK(poses[111].velocity_enu_mps[1] == Approx(2.0 + 0.5 * 0.01));
}

TEST_CASE("a commanded turn is an arc of the turning circle") {
  NodeUnderTest<VehicleNode> vehicle(going_north());
  vehicle.give("command", command(0_s, kPi / 2, 2.0));
  const auto poses = vehicle.step_until<msg::Pose>("pose", 30_s);
  const frames::Vec2 centre(10, 0.2);  // 0.1 s straight on, then the circle to starboard
  for (std::size_t i = 10; i <= 790; ++i) {
    const frames::Vec2 place(poses[i].position_enu_m[0], poses[i].position_enu_m[1]);
    REQUIRE_THAT((place - centre).norm(), WithinAbs(10.0, 1e-9));
  }
  CHECK(poses[1000].velocity_enu_mps[0] == Approx(2.0));
  CHECK(poses[400].rate_body_radps[2] == Approx(0.2));
}

TEST_CASE("speed is limited to what the vehicle can do, and nonsense is ignored and counted") {
  NodeUnderTest<VehicleNode> vehicle(going_north());
  vehicle.give("command", command(0_s, 0.0, 99.0));
  vehicle.give("command", command(20_s, std::numeric_limits<double>::quiet_NaN(), 1.0));
  const auto poses = vehicle.step_until<msg::Pose>("pose", 30_s);
  CHECK(poses[2000].velocity_enu_mps[1] == Approx(4.0));
  CHECK(poses[3000].velocity_enu_mps[1] == Approx(4.0));
  const auto health = vehicle.step_until<msg::Health>("health", 31_s);
  REQUIRE(health.size() == 1);
  CHECK(health[0].counters.at(0).name == "refused_given/command.heading_grid_rad");
}

TEST_CASE("roll and heave are the sinusoids of the scenario") {
  VehicleConfig config = going_north();
  config.waves.roll_rad = {0.1, 8.0, 0.0};
  config.waves.heave_m = {0.5, 4.0, 0.0};
  NodeUnderTest<VehicleNode> vehicle(config);
  const auto poses = vehicle.step_until<msg::Pose>("pose", 4_s);
  CHECK(poses[100].position_enu_m[2] == Approx(-3.0 + 0.5));
  CHECK(frames::attitude_of(frames::quaternion_of(poses[200].enu_from_body)).roll_rad == Approx(0.1));
  CHECK(poses[0].velocity_enu_mps[2] == Approx(0.5 * 2 * kPi / 4.0));
}

TEST_CASE("the pose rate does not change the path") {
  VehicleConfig slow = going_north();
  slow.pose_rate_hz = 10;
  NodeUnderTest<VehicleNode> a(going_north()), b(slow);
  for (auto* vehicle : {&a, &b}) vehicle->give("command", command(1_s, 2.5, 3.5), command(9_s, 1.0, 0.5));
  const auto fine = a.step_until<msg::Pose>("pose", 20_s);
  const auto coarse = b.step_until<msg::Pose>("pose", 20_s);
  for (int k = 0; k < 3; ++k)
    CHECK_THAT(fine.back().position_enu_m[k], WithinAbs(coarse.back().position_enu_m[k], 1e-9));
}

TEST_CASE("with lines planned over a chart the vehicle appears when the chart does") {
  VehicleConfig config = going_north();
  config.start.reset();
  config.plan.mission.auto_plan = AutoPlan{};
  config.plan.mission.auto_plan->heading_rad = 0.0;
  config.plan.mission.run_in_m = 20;
  config.plan.mission.depth_m = 3;
  NodeUnderTest<VehicleNode> vehicle(config);
  vehicle.give_at("chart", 0_s, flat_chart(25));
  const auto poses = vehicle.step_until<msg::Pose>("pose", 1_s);
  REQUIRE(poses.size() == 91);
  CHECK(poses[0].stamp_ns == 100'000'000);
  CHECK(poses[0].position_enu_m[2] == Approx(-3.0));
  const auto lines = planned_lines(config.plan, flat_chart(25));
  CHECK(poses[0].position_enu_m[1] == Approx(lines[0].start_enu_m.y() - 20));
}

TEST_CASE("a chart without room ends the run with the reason") {
  VehicleConfig config = going_north();
  config.start.reset();
  config.plan.scenario_file = "bay.yaml";
  config.plan.mission.auto_plan = AutoPlan{};
  NodeUnderTest<VehicleNode> vehicle(config);
  vehicle.give_at("chart", 0_s, flat_chart(900));
  CHECK_THROWS_AS(vehicle.run_until(1_s), ConfigError);
}
