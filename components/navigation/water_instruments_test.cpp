#include <catch2/catch.hpp>

#include "components/navigation/testing/circle.h"
#include "components/sonar/testing/seabed.h"
#include "kernels/water/sound_speed.h"

using namespace ensonify;
using namespace ensonify::test_run;
using Catch::WithinAbs;

namespace {

constexpr double kTide_m = 3.0;

/// A current that turns and weakens with depth, 3 m of tide, warm water above cold, and perfect simple instruments.
NavigationConfig in_layers(const std::string& yaml) {
  NavigationConfig config = config_of(yaml);
  config.heights.tide = vertical::Tide(kTide_m);
  config.heights.current.profile = {{0.0, {0.6, 0.2}}, {20.0, {0.2, -0.2}}};
  config.water.sound_speed = refraction::SoundSpeedProfile({{0.0, 1510.0}, {20.0, 1490.0}});
  config.water.column = water::Column({{15.0, 31.0, 0.0}, {5.0, 35.0, 20.0}});
  config.sigma = {0, 0, 0, 0, 0, 0, 0};
  return config;
}

/// The current of those layers: smooth at both knots, where shear begins and ends.
frames::Vec3 current_in_layers(double depth_m) {
  const double down = depth_m / 20.0, share = down * down * (3.0 - 2.0 * down);
  return {0.6 - 0.4 * share, 0.2 - 0.4 * share, 0.0};
}

frames::Vec3 vec(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

}  // namespace

TEST_CASE("a CTD reports depth below the water level and the water's properties there") {
  NodeUnderTest<NavigationNode> navigation(in_layers("ctd: { position_m: [0, 0, 2], rate_hz: 2 }"));
  run_for(navigation, 5, [](double t) { return -1.0 - t; });
  const auto readings = navigation.step_until<msg::Ctd>("ctd", 5_s);
  REQUIRE(readings.size() == 11);
  for (const msg::Ctd& ctd : readings) {
    const double t = 1e-9 * static_cast<double>(ctd.stamp_ns);
    const double below_datum_m = 1.0 + t + 2.0 * std::cos(5 * kDegree * std::sin(2 * kPi * t / 6));
    CHECK(ctd.depth_m == Approx(below_datum_m + kTide_m));
    CHECK(ctd.temperature_degc == Approx(15.0 - 0.5 * below_datum_m));
    CHECK(ctd.salinity_psu == Approx(31.0 + 0.2 * below_datum_m));
    CHECK(ctd.sound_speed_mps == water::sound_speed_mps(ctd.temperature_degc, ctd.salinity_psu, ctd.depth_m));
  }
}

TEST_CASE("a sound speed probe of its own takes the place of the simple one") {
  NodeUnderTest<NavigationNode> navigation(
      in_layers("sound_speed: { rate_hz: 2, latency_s: 0.2, errors: { bias_mps: 0.5 }, outages_s: [2, 3] }"));
  run_for(navigation, 5, [](double) { return -10.0; });
  const auto readings = navigation.step_until<msg::SoundSpeed>("sound_speed", 5_s);
  CHECK(readings.size() == 8);  // of 11: two in the outage, and the last is still under way
  for (const msg::SoundSpeed& reading : readings) CHECK(reading.sound_speed_mps == Approx(1500.5));
}

TEST_CASE("a current profiler measures each depth down to where side lobes reach the bottom") {
  NodeUnderTest<NavigationNode> navigation(in_layers(
      "current_profiler: { position_m: [1, 0, 1], rotation_deg: [0, 0, 45], slant_deg: 20, blanking_m: 1, bin_m: 2 }"));
  navigation.give_at("tile", 0_s, tile_of(512.0, 1.0, [](double, double) { return -20.0; }));
  run_for(navigation, 6, kLevel);
  const auto profiles = navigation.step_until<msg::CurrentProfile>("current_profile", 6_s);
  REQUIRE(profiles.size() == 7);
  for (const msg::CurrentProfile& profile : profiles) {
    const msg::Pose truth = circling(SimTime{profile.stamp_ns}, kLevel);
    const frames::Quaternion enu_from_body = frames::quaternion_of(truth.enu_from_body);
    const frames::Vec3 lever(1, 0, 1);
    const frames::Vec3 own_mps = vec(truth.velocity_enu_mps) + enu_from_body * vec(truth.rate_body_radps).cross(lever);
    // 18 m of water under it (along a roll of 5 degrees at most): cos(20 degrees) of that is 16.9 m, eight bins of 2 m
    // behind the blanking do not fit, seven do.
    REQUIRE(profile.below_transducer_m.size() == 7);
    REQUIRE(profile.velocity_body_mps.cols() == 3);
    for (std::size_t bin = 0; bin < 7; ++bin) {
      const frames::Vec3 place =
          vec(truth.position_enu_m) + enu_from_body * (lever + frames::Vec3(0, 0, profile.below_transducer_m[bin]));
      const frames::Vec3 passing(profile.velocity_body_mps(bin, 0), profile.velocity_body_mps(bin, 1),
                                 profile.velocity_body_mps(bin, 2));
      const frames::Vec3 current_mps = enu_from_body * passing + own_mps;
      CHECK((current_mps - current_in_layers(-place.z())).norm() < 1e-9);
    }
  }
}

TEST_CASE("without a pager a profiler sees no bottom") {
  NodeUnderTest<NavigationNode> navigation(in_layers("current_profiler: { bins: 12, longest_m: 100 }"));
  run_for(navigation, 1, kLevel);
  const auto profiles = navigation.step_until<msg::CurrentProfile>("current_profile", 1_s);
  REQUIRE(!profiles.empty());
  CHECK(profiles[0].below_transducer_m.size() == 12);
}

TEST_CASE("a Doppler log tracks the water below it, where it has no bottom either") {
  NodeUnderTest<NavigationNode> navigation(in_layers("velocity_log: { water_track_m: 9, rotation_deg: [0, 0, 30] }"));
  run_for(navigation, 6, kLevel);
  const auto logs = navigation.step_until<msg::VelocityLog>("velocity_log", 6_s);
  REQUIRE(logs.size() == 31);
  for (const msg::VelocityLog& log : logs) {
    const msg::Pose truth = circling(SimTime{log.stamp_ns}, kLevel);
    const frames::Quaternion enu_from_body = frames::quaternion_of(truth.enu_from_body);
    const frames::Vec3 water_mps = current_in_layers(1.0 - (enu_from_body * frames::Vec3(0, 0, 9)).z());
    CHECK(!log.bottom_lock);
    CHECK(log.water_lock);
    CHECK((enu_from_body * vec(log.water_velocity_body_mps) + water_mps - vec(truth.velocity_enu_mps)).norm() < 1e-9);
  }
}

namespace {

/// 60 m east of the ship, 80 m down, north at 3 m/s.
msg::Pose towed(SimTime at) {
  msg::Pose pose;
  pose.stamp_ns = at.count();
  pose.position_enu_m = {60.0, 3.0 * seconds(at), -81.0};
  pose.velocity_enu_mps = {0.0, 3.0, 0.0};
  pose.enu_from_body = frames::wxyz_of(frames::enu_from_body(frames::Attitude{}));
  return pose;
}

template <class Message>
std::vector<Message> received(const std::string& port, const std::string& usbl) {
  NodeUnderTest<NavigationNode> navigation(in_layers("usbl: { range_white_m: 0, bearing_white_deg: 0, " + usbl + " }"));
  navigation.give_each("target", 12_s, 10_ms, &towed);
  run_for(navigation, 12, kLevel);
  return navigation.step_until<Message>(port, 12_s);
}
std::vector<msg::UsblFix> fixes_of(const std::string& usbl) { return received<msg::UsblFix>("usbl", usbl); }

}  // namespace

TEST_CASE("USBL finds a vehicle's transponder where it was when it answered") {
  const auto fixes = fixes_of("position_m: [2, 1, 3], rotation_deg: [0, 0, 90], transponder_m: [-1, 0, 0]");
  REQUIRE(fixes.size() >= 5);
  for (const msg::UsblFix& fix : fixes) {
    REQUIRE(fix.valid);
    const double t = 1e-9 * static_cast<double>(fix.stamp_ns);
    // The target's poses stand 10 ms apart and are joined by straight lines; the ship's estimate is of the same moment.
    CHECK((vec(fix.position_enu_m) - frames::Vec3(60, 3.0 * t - 1.0, -81)).norm() < 0.01);
    const double age_s = std::ceil(t) - t;
    CHECK_THAT(age_s, WithinAbs(fix.range_m / 1500.0, 1e-4));
  }
}

TEST_CASE("a USBL array turned by an unmeasured degree errs by a degree of the range") {
  const auto right = fixes_of("rotation_deg: [0, 0, 0]");
  const auto turned = fixes_of("rotation_deg: [0, 0, 1], measured_rotation_deg: [0, 0, 0]");
  REQUIRE(right.size() == turned.size());
  const frames::Vec3 off = vec(turned.back().position_enu_m) - vec(right.back().position_enu_m);
  const msg::Pose ship = circling(12_s, kLevel);
  const frames::Vec3 apart = vec(right.back().position_enu_m) - vec(ship.position_enu_m);
  CHECK(off.norm() == Approx(apart.head<2>().norm() * kDegree).epsilon(0.05));

  const auto unanswered = fixes_of("rotation_deg: [180, 0, 0]");  // it points up
  REQUIRE(!unanswered.empty());
  CHECK(!unanswered.back().valid);
  CHECK(fixes_of("outages_s: [0, 100]").empty());
}

TEST_CASE("health says why a transponder does not reply") {
  const auto last = [](const std::string& usbl) { return received<msg::Health>("health", usbl).back(); };
  const auto up = last("rotation_deg: [180, 0, 0]");
  CHECK(up.state == "degraded");
  // 80 m down, 57 m to the east and 12 m to the north: 36 degrees off straight down.
  CHECK(up.message == "usbl: the transponder is 144 degrees off the array's axis, received within 74; turn the array");
  CHECK(last("longest_m: 50").message == "usbl: the transponder is 99 m away, received within 50");
  CHECK(received<msg::Health>("health", "rotation_deg: [0, 0, 0]").empty());  // nothing to report
}

TEST_CASE("the graded instruments' clocks lose their pulse and drift") {
  NodeUnderTest<NavigationNode> navigation(
      in_layers("ctd: { rate_hz: 1, clock: { drift_ppm: 1000, unlocked_s: [2, 6] } }"));
  run_for(navigation, 8, kLevel);
  const auto readings = navigation.step_until<msg::Ctd>("ctd", 8_s);
  REQUIRE(readings.size() == 9);
  CHECK(readings[1].stamp_ns == 1'000'000'000);
  CHECK(readings[5].stamp_ns == 5'003'000'000);  // three seconds without the pulse
  CHECK(readings[7].stamp_ns == 7'000'000'000);
}
