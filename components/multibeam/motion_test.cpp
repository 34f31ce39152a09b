#include <catch2/catch.hpp>
#include <cmath>

#include "components/multibeam/testing/survey.h"

// The whole head on a vehicle that moves, and whose sensors and mountings err.

using namespace ensonify;
using Catch::WithinAbs;

TEST_CASE("with true navigation, motion during the ping and second echoes keep depths right") {
  auto config = shallow();
  const Track track{.speed_mps = 3.0, .roll_rad = 0.1, .heave_m = 0.5, .depth_m = 1.0};
  const Spread port_and_starboard = depth_error(survey(config, track, 5_s), 0.0, 60.0);
  CHECK(std::abs(port_and_starboard.mean) < 0.01);
  CHECK(port_and_starboard.sd < 0.06);
  // One beam in 10,000 would take it, at 39 m, for the seabed: alone it scatters a quarter of them all by 20 cm.
  config.refuse_second_echo = false;
  CHECK(depth_error(survey(config, track, 5_s), 0.0, 60.0).sd > 0.1);
}

TEST_CASE("a 1 m error in the measured lever arm shows as 1 m in the soundings") {
  auto wrong = shallow();
  wrong.mounting.measured.position_body_m = {0.0, 1.0, 0.0};  // starboard: east, as the bow is to north
  const auto right = survey(shallow(), {}, 500_ms), off = survey(wrong, {}, 500_ms);
  REQUIRE(right.size() == off.size());
  for (std::size_t beam = 0; beam < 256; ++beam) {
    CHECK_THAT(off[0].position_enu_m(beam, 0) - right[0].position_enu_m(beam, 0), WithinAbs(1.0, 1e-9));
    CHECK_THAT(off[0].position_enu_m(beam, 2), WithinAbs(right[0].position_enu_m(beam, 2), 1e-9));
  }
}

namespace {

/// How far the swath is turned: by what the soundings of a beam near either edge give, and by theory.
struct EdgeRoll {
  double found_rad, theory_rad;
};

/// Of each ping whose edges are received, when the beams were steered against the roll of `latency_s` before
/// transmission.
std::vector<EdgeRoll> edge_rolls(const std::vector<msg::Soundings>& pings, double roll_rad, double latency_s) {
  std::vector<EdgeRoll> rolls;
  for (const auto& s : pings) {
    constexpr std::size_t kPort = 10, kStarboard = 245;
    const double transmission_s = static_cast<double>(s.stamp_ns) * 1e-9;
    if (s.valid[kPort] == 0 || s.valid[kStarboard] == 0 || transmission_s < latency_s) continue;
    const auto across = [&](std::size_t beam) {
      return std::atan2(s.position_enu_m(beam, 0), -s.position_enu_m(beam, 2));  // east is starboard
    };
    const double reception_s = transmission_s + 0.5 * (s.travel_time_s[kPort] + s.travel_time_s[kStarboard]);
    rolls.push_back({0.5 * (across(kPort) + across(kStarboard)),
                     roll_rad * (std::sin(1.3 * (transmission_s - latency_s)) - std::sin(1.3 * reception_s))});
  }
  return rolls;
}

}  // namespace

TEST_CASE("with ten degrees of roll the swath stays where the motion sensor steered it") {
  auto config = shallow();
  config.range_m = 80.0;
  const double roll = 10.0 * MultibeamConfig::kDegree;
  const Track track{.roll_rad = roll, .motion_sensor = true};
  for (const double latency_s : {0.0, 0.1}) {
    config.attitude_latency_s = latency_s;
    const auto rolls = edge_rolls(survey(config, track, 3_s), roll, latency_s);
    REQUIRE(rolls.size() > 15);
    double largest = 0.0;
    for (const EdgeRoll& edge : rolls) {
      // A sounding scatters by 0.1 m of 50 m; both edges together by less.
      CHECK_THAT(edge.found_rad, WithinAbs(edge.theory_rad, 0.3 * MultibeamConfig::kDegree));
      largest = std::max(largest, std::abs(edge.theory_rad));
    }
    // 13 degrees a second, for the latency and the 0.06 s that the echo takes.
    CHECK(largest == Approx(1.3 * roll * (latency_s + 0.06)).epsilon(0.2));
  }

  config.roll_stabilised = false;
  int turned = 0, pings = 0;
  for (const auto& s : survey(config, track, 3_s)) {
    const double roll_now = roll * std::sin(1.3 * static_cast<double>(s.stamp_ns) * 1e-9);
    if (roll_now < 0.9 * roll) continue;
    ++pings;  // the port edge points up by as much: to 74 degrees at least, if it receives anything
    const double edge_rad = std::atan2(s.position_enu_m(0, 0), -s.position_enu_m(0, 2));
    turned += s.valid[0] == 0 || edge_rad < -73.0 * MultibeamConfig::kDegree;
  }
  CHECK(pings > 5);
  CHECK(turned == pings);
}

namespace {

/// Soundings with a probe at the face that gives 1 % more than 1500 m/s, and with none, of a head turned to starboard.
std::array<std::vector<msg::Soundings>, 2> wrong_probe_and_none(double mounted_rad) {
  auto config = shallow();
  config.swath_rad = 90.0 * MultibeamConfig::kDegree;
  config.mounting.actual.body_from_head = config.mounting.measured.body_from_head =
      frames::Quaternion(Eigen::AngleAxisd(mounted_rad, frames::Vec3::UnitX()));
  const Track track{.speed_mps = 3.0};
  Head head(config);
  msg::SoundSpeed probe;
  probe.sound_speed_mps = 1515.0;
  head.give("sound_speed", probe);
  give_motion(head, track, 2_s);
  head.give("tile", flat_tile(-20.0));
  return {head.step_until<msg::Soundings>("soundings", 2_s), survey(config, track, 2_s)};
}

/// Depth of soundings whose beam lies between two angles of the head, starboard positive, less 20 m.
double mean_depth_error(const std::vector<msg::Soundings>& pings, double from_deg, double to_deg) {
  double sum = 0.0;
  int n = 0;
  for (const auto& s : pings) {
    for (std::size_t beam = 0; beam < s.valid.size(); ++beam) {
      const double angle_deg = s.beam_angle_rad[beam] / MultibeamConfig::kDegree;
      if (s.valid[beam] == 0 || angle_deg < from_deg || angle_deg > to_deg) continue;
      sum += -s.position_enu_m(beam, 2) - 20.0, ++n;
    }
  }
  return sum / n;
}

}  // namespace

TEST_CASE("a wrong probe leaves a level flat array's soundings right by Snell's invariant") {
  const auto [wrong, none] = wrong_probe_and_none(0.0);
  CHECK(wrong.back().applied.sound_speed_mps == 1515.0);
  CHECK(none.back().applied.sound_speed_mps == Approx(1500.0));
  for (const auto& [from, to] : {std::pair{-45.0, -15.0}, {-15.0, 15.0}, {15.0, 45.0}}) {
    // The same echoes a hundredth further out: 1000 and more soundings of 2 cm, so a mean to a millimetre.
    CHECK(std::abs(mean_depth_error(wrong, from, to) - mean_depth_error(none, from, to)) < 0.005);
  }
}

TEST_CASE("a wrong probe bends the swath of a tilted array as theory says") {
  const double tilt = -20.0 * MultibeamConfig::kDegree;  // about the bow: points to starboard
  const auto [wrong, none] = wrong_probe_and_none(tilt);
  for (const double beam_deg : {25.0, 35.0}) {
    const double beam = beam_deg * MultibeamConfig::kDegree;
    // Where it really points, and where it is assumed to; then at the refracted angle in the water of 1500 m/s.
    const double pointed = std::asin(std::sin(beam) * 1500.0 / 1515.0) - tilt, estimated = beam - tilt;
    const double traced = std::asin(std::sin(estimated) * 1500.0 / 1515.0);
    const double theory = 20.0 / std::cos(pointed) * std::cos(traced) - 20.0;
    const double found = mean_depth_error(wrong, beam_deg - 2.0, beam_deg + 2.0) -
                         mean_depth_error(none, beam_deg - 2.0, beam_deg + 2.0);
    // 5 %, and what 300 soundings of 4 cm scatter on either side, three times.
    CHECK(found == Approx(theory).epsilon(0.05).margin(0.01));
    CHECK(std::abs(theory) > 0.05);
  }
}

TEST_CASE("soundings never use the truth: an estimate 5 m off moves them by 5 m") {
  const Track off{.speed_mps = 2.0, .roll_rad = 0.05, .offset_enu_m = {3.0, -4.0, 0.0}};
  Track right = off;
  right.offset_enu_m = frames::Vec3::Zero();
  const auto a = survey(shallow(), right, 1_s), b = survey(shallow(), off, 1_s);
  REQUIRE(a.size() == b.size());
  for (std::size_t ping = 0; ping < a.size(); ++ping) {
    CHECK(a[ping].travel_time_s == b[ping].travel_time_s);  // what is received is the same
    for (std::size_t beam = 0; beam < 256; ++beam) {
      REQUIRE_THAT(b[ping].position_enu_m(beam, 0) - a[ping].position_enu_m(beam, 0), WithinAbs(3.0, 1e-9));
      REQUIRE_THAT(b[ping].position_enu_m(beam, 1) - a[ping].position_enu_m(beam, 1), WithinAbs(-4.0, 1e-9));
    }
  }
}

TEST_CASE("with yaw stabilised the fans of sectors stay across the mean heading") {
  MultibeamConfig config = shallow();
  config.sectors = {{.frequency_hz = 290e3}, {.frequency_hz = 300e3}, {.frequency_hz = 310e3}};
  config.heading_mean_s = 1000.0;
  const double yaw = 5.0 * MultibeamConfig::kDegree;
  // A vehicle that was commanded to head north for long, and now heads 5 degrees to starboard of it.
  const auto along_m = [&](bool stabilised) {
    config.yaw_stabilised = stabilised;
    Head head(config);
    msg::Attitude north;
    head.give("attitude", north);
    give_motion(head, {.heading_rad = yaw, .motion_sensor = true}, 300_ms);
    head.give("tile", flat_tile(-20.0));
    const auto s = head.step_until<msg::Soundings>("soundings", 300_ms).front();
    REQUIRE(s.applied.yaw_stabilised == stabilised);
    REQUIRE(s.sector.size() == 256);
    std::array<double, 2> edges{};  // north of the head, about the middle of the outer sectors: 43 degrees
    for (std::size_t i = 0; i < 10; ++i) {
      edges[0] += 0.1 * s.position_enu_m(38 + i, 1);
      edges[1] += 0.1 * s.position_enu_m(208 + i, 1);
    }
    return edges;
  };
  // Unstabilised the fan turns with the head: 18.9 m out it is 1.65 m off to the north (port) and the south.
  const auto turned = along_m(false), held = along_m(true);
  const double off_m = 20.0 * std::tan(43.3 * MultibeamConfig::kDegree) * std::sin(yaw);
  CHECK(turned[0] == Approx(off_m).epsilon(0.05));
  CHECK(turned[1] == Approx(-off_m).epsilon(0.05));
  CHECK_THAT(held[0], WithinAbs(0.0, 0.05));
  CHECK_THAT(held[1], WithinAbs(0.0, 0.05));
}
