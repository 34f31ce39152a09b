#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "components/navigation/testing/circle.h"
#include "components/sonar/testing/mesh.h"
#include "components/sonar/testing/seabed.h"

using namespace ensonify;
using namespace ensonify::test_run;
using Catch::WithinAbs;

namespace {

std::string faults_of(const std::string& yaml) {
  try {
    config_of(yaml);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

template <class Height>
frames::Vec3 off_m(const msg::Estimate& estimate, const Height& height) {
  const msg::Pose truth = circling(SimTime{estimate.stamp_ns}, height);
  return {estimate.position_enu_m[0] - truth.position_enu_m[0], estimate.position_enu_m[1] - truth.position_enu_m[1],
          estimate.position_enu_m[2] - truth.position_enu_m[2]};
}

}  // namespace

TEST_CASE("every grade reads, and names its kind") {
  const std::string folder = std::string(std::getenv("ENSONIFY_SOURCE")) + "/components/navigation/grades";
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().stem().string();
    std::string kind;
    for (const char* known : {"gnss", "imu", "motion_sensor", "heading", "velocity_log", "depth", "sound_speed", "ctd",
                              "current_profiler", "usbl"}) {
      if (name.starts_with(std::string(known) + "_")) kind = known;
    }
    INFO(name);
    REQUIRE(!kind.empty());
    CHECK(faults_of(kind + ": { grade: " + name.substr(kind.size() + 1) + " }") == "");
    CHECK(ConfigReader::from_file(entry.path().string()).has("stamped_at"));
    ++count;
  }
  CHECK(count == 19);
  CHECK(config_of("imu: { grade: fog }").instruments.imu->gyro.turn_on_bias == Approx(0.02 * kDegree / 3600));
  CHECK(config_of("imu: { grade: fog, gyro: { bias_degph: 0.5 } }").instruments.imu->gyro.turn_on_bias ==
        Approx(0.5 * kDegree / 3600));
}

TEST_CASE("a user's grade file is found beside the file that names it, from any directory") {
  const auto folder = std::filesystem::temp_directory_path() / "ensonify_grade_beside";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "mine.yaml") << "gyro: { bias_degph: 0.5 }\n";
  std::ofstream(folder / "nav.yaml") << "imu: { grade: mine.yaml }\n";
  ConfigReader from = ConfigReader::from_file((folder / "nav.yaml").string());
  const Instruments instruments = NavigationParameters::read(from).instruments;
  from.finish();
  CHECK(instruments.imu->gyro.turn_on_bias == Approx(0.5 * kDegree / 3600));
  std::filesystem::remove_all(folder);
  CHECK(faults_of("imu: { grade: mine.yaml }").find("nav.yaml:1:15: imu.grade: \"mine.yaml\": no such file") !=
        std::string::npos);
}

TEST_CASE("impossible instruments are refused with place and cause") {
  CHECK(faults_of("gnss: { rate_hz: -5 }").find("nav.yaml:1:18: gnss.rate_hz: -5 is outside [0.01, 1000]") !=
        std::string::npos);
  CHECK(faults_of("imu: { grade: quantum }")
            .find("nav.yaml:1:15: imu.grade: \"quantum\" is no grade of this "
                  "instrument; allowed: fog, mems, rlg, tactical, or a file *.yaml") != std::string::npos);
  CHECK(faults_of("depth: { errors: { white_m: .nan } }").find("depth.errors.white_m") != std::string::npos);
  CHECK(faults_of("gnss: { outages_s: [10, 5] }").find("gnss.outages_s: is not [from, to, from, to, ...]") !=
        std::string::npos);
  CHECK(faults_of("velocity_log: { dropout: 2 }").find("dropout: 2 is outside [0, 1]") != std::string::npos);
  CHECK(faults_of("heading: { kind: psychic }").find("heading.kind") != std::string::npos);
}

TEST_CASE("FOG and RTK: the estimate is within centimetres and as uncertain as it says") {
  NodeUnderTest<NavigationNode> navigation(
      config_of("imu: { grade: fog, position_m: [0.3, 0.1, -0.5] }\ngnss: { grade: rtk, position_m: [-1, 0, -3] }"));
  run_for(navigation, 60, kLevel);
  const auto estimates = navigation.step_until<msg::Estimate>("estimate", 60_s);
  const auto increments = navigation.step_until<msg::InertialIncrements>("imu", 60_s);
  CHECK(estimates.size() == 6001);
  CHECK(increments.size() == 6000);
  CHECK_THAT(increments.back().velocity_mps[2] / increments.back().interval_s, WithinAbs(-9.8, 0.3));
  for (std::size_t i = 3000; i < estimates.size(); i += 500) {
    const frames::Vec3 off = off_m(estimates[i], kLevel);
    const double sigma = std::sqrt(estimates[i].position_covariance_enu_m2[0]);
    REQUIRE(sigma > 0.0);
    REQUIRE(sigma < 0.1);
    // Six numbers of 3 components; five sigma leave no doubt, three would fail once in twenty seeds.
    REQUIRE(std::abs(off.x()) < 5 * sigma);
    REQUIRE(std::abs(off.y()) < 5 * std::sqrt(estimates[i].position_covariance_enu_m2[4]));
    REQUIRE(std::abs(off.z()) < 5 * std::sqrt(estimates[i].position_covariance_enu_m2[8]));
    const msg::Pose truth = circling(SimTime{estimates[i].stamp_ns}, kLevel);
    CHECK(
        frames::quaternion_of(estimates[i].enu_from_body).angularDistance(frames::quaternion_of(truth.enu_from_body)) <
        0.3 * kDegree);
    CHECK_THAT(estimates[i].velocity_enu_mps[0], WithinAbs(truth.velocity_enu_mps[0], 0.1));
  }
}

TEST_CASE("in a dive there are no fixes; log and depth hold the estimate") {
  // 5 m down from 20 s on, over a bottom at 20 m; without depth and log the inertial system alone drifts off.
  const auto dive = [](double t) { return t < 20 ? -0.2 : t < 30 ? -0.2 - 0.5 * (t - 20) : -5.2; };
  const std::string carried =
      "imu: { grade: tactical }\ngnss: { grade: rtk, position_m: [0, 0, -1] }\n"
      "velocity_log: { grade: performance, position_m: [0, 0, 0.5] }\ndepth: { grade: quartz }\naltimeter: {}\n";
  NodeUnderTest<NavigationNode> navigation(config_of(carried));
  navigation.give_at("tile", 0_s, tile_of(512.0, 1.0, [](double, double) { return -20.0; }));
  run_for(navigation, 90, dive);
  const auto positions = navigation.step_until<msg::Position>("position", 90_s);
  REQUIRE(!positions.empty());
  CHECK(positions.back().stamp_ns < 23'000'000'000);  // the antenna goes under at 21.6 s
  CHECK(positions.front().quality == 4);

  const auto logs = navigation.step_until<msg::VelocityLog>("velocity_log", 90_s);
  REQUIRE(logs.size() == 451);
  int locked = 0;
  for (const auto& log : logs) {
    if (!log.bottom_lock) continue;
    ++locked;
    REQUIRE_THAT(log.velocity_body_mps[0], WithinAbs(2.0, 0.1));
  }
  CHECK(locked > 440);
  CHECK_THAT(logs.back().altitude_m, WithinAbs(20.0 - 5.7, 0.3));
  CHECK_THAT(navigation.step_until<msg::Depth>("depth", 90_s).back().depth_m, WithinAbs(5.2, 0.3));
  const auto altitudes = navigation.step_until<msg::Altitude>("altitude", 90_s);
  CHECK(altitudes.back().valid);
  const auto estimates = navigation.step_until<msg::Estimate>("estimate", 90_s);
  CHECK(off_m(estimates.back(), dive).norm() < 1.5);  // 140 m under water; one degree and a per cent
  CHECK(std::sqrt(estimates.back().position_covariance_enu_m2[0]) >
        std::sqrt(estimates[2000].position_covariance_enu_m2[0]));

  NodeUnderTest<NavigationNode> blind(config_of(carried));
  run_for(blind, 2, dive);
  CHECK(!blind.step_until<msg::VelocityLog>("velocity_log", 2_s).back().bottom_lock);
}

TEST_CASE("an altimeter's beam ends on a mesh while it is there") {
  NodeUnderTest<NavigationNode> navigation(config_of("altimeter: {}"));
  navigation.give_at("tile", 0_s, tile_of(512.0, 1.0, [](double, double) { return -20.0; }));
  navigation.give_at("mesh", 4_s, table_of(300.0, -12.0));
  navigation.give_at("mesh_release", 8_s, msg::MeshRelease{0});
  run_for(navigation, 12, kLevel);
  const auto reported = [&](SimTime until) { return navigation.step_until<msg::Altitude>("altitude", until).back(); };
  for (const auto& [until, height_m] : {std::pair{3900_ms, -20.0}, {7900_ms, -12.0}, {11900_ms, -20.0}}) {
    const auto altitude = reported(until);
    CHECK(altitude.valid);
    CHECK_THAT(altitude.range_m, WithinAbs(-1.0 - height_m, 0.3));  // rolling by 5 degrees makes 0.08 m
  }
}

TEST_CASE("outages silence an instrument, latency delays it, its clock stamps it") {
  NodeUnderTest<NavigationNode> navigation(
      config_of("gnss: { position_m: [0, 0, -3], rate_hz: 1, outages_s: [3, 6], latency_s: 0.25, clock: { locked: "
                "false, offset_s: 0.1 } }\n"
                "depth: { rate_hz: 1, latency_s: 0.5, stamped_at: output }"));
  run_for(navigation, 8, kLevel);
  CHECK(navigation.step_until<msg::Position>("position", 2.24_s).size() == 2);
  CHECK(navigation.step_until<msg::Position>("position", 2.25_s).size() == 1);
  const auto later = navigation.step_until<msg::Position>("position", 8_s);
  // The outage ends at 6 s, the receiver needs 5 s more.
  CHECK(later.empty());
  const auto depths = navigation.step_until<msg::Depth>("depth", 8_s);
  REQUIRE(depths.size() == 8);
  CHECK(depths[2].stamp_ns == 2'500'000'000);
  NodeUnderTest<NavigationNode> again(
      config_of("gnss: { position_m: [0, 0, -3], rate_hz: 1, clock: { locked: false, offset_s: 0.1 } }"));
  run_for(again, 2, kLevel);
  CHECK(again.step_until<msg::Position>("position", 2_s).back().stamp_ns == 2'100'000'000);
}

TEST_CASE("heave has no draught in it; delayed heave is right a window later") {
  const auto waves = [](double t) { return -3.0 + 0.5 * std::sin(2 * kPi * t / 8); };
  NodeUnderTest<NavigationNode> navigation(
      config_of("motion_sensor: { rate_hz: 10, heave_cutoff_s: 30, delayed_heave_s: 75 }"));
  run_for(navigation, 300, waves);
  const auto attitudes = navigation.step_until<msg::Attitude>("attitude", 300_s);
  double mean = 0.0;
  for (std::size_t i = 2000; i < 2800; ++i) mean += attitudes[i].heave_m / 800;  // ten periods
  CHECK_THAT(mean, WithinAbs(0.0, 0.01));
  const auto delayed = navigation.step_until<msg::DelayedHeave>("delayed_heave", 300_s);
  REQUIRE(!delayed.empty());
  CHECK(delayed.back().stamp_ns == 225'000'000'000);
  for (const auto& heave : delayed) {
    REQUIRE_THAT(heave.heave_m,
                 WithinAbs(0.5 * std::sin(2 * kPi * 1e-9 * static_cast<double>(heave.stamp_ns) / 8), 0.01));
  }
}

TEST_CASE("the same seed gives the same estimate, another one another") {
  const auto last = [](std::uint64_t seed) {
    NodeUnderTest<NavigationNode> navigation(config_of("imu: { grade: mems }\ngnss: { grade: dgps }", seed));
    run_for(navigation, 2, kLevel);
    return navigation.step_until<msg::Estimate>("estimate", 2_s).back().position_enu_m;
  };
  CHECK(last(1) == last(1));
  CHECK(last(1) != last(2));
}

TEST_CASE("a compass gives the heading of attitude, clockwise from grid north") {
  NodeUnderTest<NavigationNode> navigation(config_of("heading: { errors: { bias_deg: 2 } }"));
  run_for(navigation, 1, kLevel);
  const auto attitudes = navigation.step_until<msg::Attitude>("attitude", 1_s);
  CHECK_THAT(attitudes.back().heading_grid_rad, WithinAbs(0.02 + 2 * kDegree, 1e-5));
}

namespace {

constexpr double kM2_radps = 1.405189e-4;

/// On a tide at its fastest: 2 m above chart datum, rising 0.2 mm/s; floating 1 m low, deeper by load by 0.3 m.
NavigationConfig on_a_tide(const std::string& yaml) {
  NavigationConfig config = config_of(yaml);
  config.heights.tide = vertical::Tide(vertical::HarmonicTide{2.0, {{kM2_radps, 1.5, kPi / 2}}});
  config.heights.floats = vertical::Loading{{}, 0.3, 0.0};
  config.heights.rest_m = -1.0;
  return config;
}
double riding(double t) { return 2.0 + 1.5 * std::sin(kM2_radps * t) - 1.0 - 0.3 + 0.5 * std::sin(2 * kPi * t / 8); }

}  // namespace

TEST_CASE("heave of a simple and of a graded sensor holds no tide, draught or load") {
  NavigationConfig simple = on_a_tide("centre_of_rotation_m: [0, 0, 0]");
  simple.sigma.heave_m = 0.0;
  NodeUnderTest<NavigationNode> ideal(simple);
  run_for(ideal, 16, riding);
  for (const auto& attitude : ideal.step_until<msg::Attitude>("attitude", 16_s)) {
    REQUIRE_THAT(attitude.heave_m,
                 WithinAbs(0.5 * std::sin(2 * kPi * 1e-9 * static_cast<double>(attitude.stamp_ns) / 8), 1e-9));
  }

  // The filter's corner is at 30 s: what it started with has died away after 160 s to exp(-0.7 * 2 pi * 160 / 30), and
  // of a steady rise nothing is left.
  NodeUnderTest<NavigationNode> graded(on_a_tide("motion_sensor: { rate_hz: 10, heave_cutoff_s: 30 }"));
  run_for(graded, 240, riding);
  const auto attitudes = graded.step_until<msg::Attitude>("attitude", 240_s);
  double mean = 0.0, early = 0.0;
  for (std::size_t i = 1600; i < 2400; ++i) mean += attitudes[i].heave_m / 800;
  for (std::size_t i = 1600; i < 2000; ++i) early += attitudes[i].heave_m / 400;
  CHECK_THAT(mean, WithinAbs(0.0, 1e-3));
  CHECK_THAT(early - mean, WithinAbs(0.0, 1e-3));  // in 20 s the tide has risen by 4 mm
}

TEST_CASE("pressure depth counts from the water level, and heights by it follow the tide") {
  NodeUnderTest<NavigationNode> navigation(
      on_a_tide("imu: { grade: fog }\ndepth: { position_m: [0, 0, 2] }\ngnss: { grade: rtk, position_m: [0, 0, -4] }"));
  const auto still = [](double t) { return riding(t) - 0.5 * std::sin(2 * kPi * t / 8); };
  run_for(navigation, 60, still);
  const auto depths = navigation.step_until<msg::Depth>("depth", 60_s);
  REQUIRE(depths.size() == 601);
  for (const auto& depth : depths) {
    const double t = 1e-9 * static_cast<double>(depth.stamp_ns);
    const double roll = 5 * kDegree * std::sin(2 * kPi * t / 6);
    REQUIRE_THAT(depth.depth_m, WithinAbs(1.3 + 2.0 * std::cos(roll), 1e-3));  // draught and load, not the tide
  }
  const auto estimate = navigation.step_until<msg::Estimate>("estimate", 60_s).back();
  CHECK_THAT(estimate.position_enu_m[2], WithinAbs(still(60), 0.05));
}

TEST_CASE("an antenna above chart datum but under the water has no fix") {
  NodeUnderTest<NavigationNode> navigation(on_a_tide("gnss: { position_m: [0, 0, -0.5] }"));
  run_for(navigation, 30, riding);
  CHECK(navigation.step_until<msg::Position>("position", 30_s).empty());
  const auto health = navigation.step_until<msg::Health>("health", 30_s).back();
  CHECK(health.state == "degraded");
  CHECK(health.message == "gnss: the antenna is -0.50 m above the water at rest: few fixes or none");
  NodeUnderTest<NavigationNode> higher(on_a_tide("gnss: { position_m: [0, 0, -2.5] }"));
  run_for(higher, 30, riding);
  CHECK(!higher.step_until<msg::Position>("position", 30_s).empty());
}
