#include "components/multibeam/node.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

#include "components/multibeam/test_survey.h"
#include "components/runtime/head/environment.h"
#include "components/runtime/head/test_seabed.h"
#include "kernels/refraction/eigenray.h"

using namespace ensonify;

namespace {

int valid_count(const msg::Soundings& s) { return std::accumulate(s.valid.flat().begin(), s.valid.flat().end(), 0); }

struct Spread {
  double mean = 0.0, sd = 0.0;
  int count = 0;
};

/// Depth minus 20 m of the soundings whose beam lies between two angles (to either side).
Spread depth_error(const std::vector<msg::Soundings>& pings, double from_deg, double to_deg) {
  double sum = 0.0, squares = 0.0;
  int n = 0;
  for (const auto& s : pings) {
    for (std::size_t beam = 0; beam < s.valid.size(); ++beam) {
      const double angle_deg = std::abs(s.beam_angle_rad[beam]) / MultibeamConfig::kDegree;
      if (s.valid[beam] == 0 || angle_deg < from_deg || angle_deg > to_deg) continue;
      const double error = -s.position_enu_m(beam, 2) - 20.0;
      sum += error, squares += error * error, ++n;
    }
  }
  if (n == 0) return {};
  return {sum / n, std::sqrt(std::max(0.0, squares / n - sum / n * sum / n)), n};
}

std::string last_health(Head& head, SimTime t) {
  const auto health = head.step_until<msg::Health>("health", t);
  return health.empty() ? "none" : health.back().state + ": " + health.back().message;
}

}  // namespace

TEST_CASE("a flat seabed 20 m below answers after 26.7 ms at nadir") {
  Head head(shallow());
  give_motion(head, {}, 200_ms);
  head.give("tile", flat_tile(-20.0));
  const auto pings = head.step_until<msg::Ping>("ping", 150_ms);
  REQUIRE(pings.size() == 1);
  const msg::Ping& ping = pings[0];
  CHECK(ping.stamp_ns == 0);
  REQUIRE(ping.amplitude_upa.rows() == 256);
  const auto nadir = ping.amplitude_upa.row(128);
  const float strongest = *std::max_element(nadir.begin(), nadir.end());
  const auto first = std::find_if(nadir.begin(), nadir.end(), [&](float a) { return a > 0.1F * strongest; });
  const double first_echo_s = ping.first_sample_s + (first - nadir.begin()) * ping.sample_period_s;
  CHECK(first_echo_s == Approx(2 * 20.0 / 1500.0).margin(1.5 * ping.sample_period_s));
}

TEST_CASE("without a tile there is no ping, and health says why") {
  Head head(shallow());
  give_motion(head, {}, 1_s);
  CHECK(head.step_until<msg::Ping>("ping", 1_s).empty());
  CHECK(head.step_until<msg::Transmit>("transmit", 1_s).empty());
  CHECK(last_health(head, 2_s) == "degraded: no seabed tile under the head at (0, 0) m");
}

TEST_CASE("a released tile is not pinged on") {
  Head head(shallow());
  give_motion(head, {}, 2_s);
  head.give("tile", flat_tile(-20.0));
  head.run_until(500_ms);
  const auto before = head.step_until<msg::Transmit>("transmit", 500_ms).size();
  CHECK(before == 6);
  head.give_at("release", 550_ms, msg::TileRelease{0, 0});
  CHECK(head.step_until<msg::Transmit>("transmit", 2_s).empty());
}

TEST_CASE("a range below the altitude is said in health") {
  auto config = shallow();
  config.range_m = 15.0;
  Head head(config);
  give_motion(head, {}, 3_s);
  head.give("tile", flat_tile(-20.0));
  CHECK(last_health(head, 2500_ms) == "degraded: the range of 15.0 m is below the altitude of 20.0 m");
}

TEST_CASE("a source level of -200 dB gives no soundings") {
  auto config = shallow();
  config.source_level_db = -200.0;
  const auto soundings = survey(config, {}, 1_s);
  REQUIRE(soundings.size() == 9);
  for (const auto& s : soundings) CHECK(valid_count(s) == 0);
}

TEST_CASE("on a flat bottom depths are unbiased from nadir to the edge of the swath") {
  const auto soundings = survey(shallow(), {}, 3_s);
  REQUIRE(soundings.size() == 29);
  for (const auto& s : soundings) CHECK(valid_count(s) == 256);
  // Phase detection (kernels/detect): under 0.05 % of depth to 60 degrees, 0.15 % to 70. The head rests, so its pings
  // share one speckle, and a mean is good to sd / sqrt(60 beams) only. Amplitude alone would scatter by 4 cm outside.
  for (const auto& [from, to, bias_m, sd_m] :
       {std::array{0.0, 15.0, 0.01, 0.025}, {15.0, 45.0, 0.01, 0.015}, {45.0, 65.0, 0.015, 0.015}}) {
    const Spread error = depth_error(soundings, from, to);
    INFO(from << " to " << to << " deg: mean " << error.mean << " m, sd " << error.sd << " m of " << error.count);
    CHECK(std::abs(error.mean) < bias_m);
    CHECK(error.sd < sd_m);
  }
}

namespace {

/// Warm water over cold: sound bends down.
WaterProfile warm_over_cold() {
  return {{}, {{0.0, 1530.0, {}, {}}, {8.0, 1520.0, {}, {}}, {12.0, 1495.0, {}, {}}, {20.0, 1490.0, {}, {}}}};
}

}  // namespace

TEST_CASE("where sound bends, soundings lie on the flat bottom if the profile is known") {
  auto config = shallow();
  config.world.water.profile = warm_over_cold();
  const auto soundings = survey(config, {}, 2_s);
  REQUIRE(soundings.size() == 19);
  // As in isovelocity water, above; the mean of 19 pings is a quarter looser than that of 29.
  for (const auto& [from, to, bias_m] : {std::array{0.0, 45.0, 0.012}, {45.0, 65.0, 0.04}}) {
    const Spread error = depth_error(soundings, from, to);
    INFO(from << " to " << to << " deg: mean " << error.mean << " m, sd " << error.sd << " m of " << error.count);
    CHECK(error.count > 1000);
    CHECK(std::abs(error.mean) < bias_m);
  }
}

TEST_CASE("a wrong applied profile bends a flat seabed as theory says") {
  auto config = shallow();
  config.world.water.profile = warm_over_cold();
  config.world.water.applied.sound_speed_mps = 1530.0;  // of the surface: right at the face, wrong below
  const auto error = [&](double angle_deg) {            // of the depth, by the exact ray of that beam
    const refraction::SoundSpeedProfile truth = true_profile(config.world);
    const double depression = (90.0 - angle_deg) * MultibeamConfig::kDegree;
    const auto ray = refraction::path_to_depth(truth, 0.0, depression, 20.0);
    return ray->travel_time_s * 1530.0 * std::sin(depression) - 20.0;
  };
  REQUIRE(error(60.0) - error(10.0) < -0.5);  // the outer swath curls up by that
  const auto bent = survey(config, {}, 1_s);
  config.world.water.applied = {};
  const auto right = survey(config, {}, 1_s);  // the same echoes: what detection errs cancels
  for (const auto& [from, to] : {std::pair{38.0, 42.0}, {53.0, 57.0}, {60.0, 64.0}}) {
    const double found = depth_error(bent, from, to).mean - depth_error(right, from, to).mean;
    INFO(from << " to " << to << " deg: " << found << " m");
    CHECK(found == Approx(error(0.5 * (from + to))).epsilon(0.05));
  }
}

TEST_CASE("outer beams are detected by phase, about the nadir amplitude has its share") {
  int nadir = 0, nadir_by_amplitude = 0, outer = 0, outer_by_phase = 0;
  for (const auto& s : survey(shallow(), {.speed_mps = 3.0}, 1_s)) {
    for (std::size_t beam = 0; beam < s.valid.size(); ++beam) {
      const double angle_deg = std::abs(s.beam_angle_rad[beam]) / MultibeamConfig::kDegree;
      if (angle_deg < 3.0) ++nadir, nadir_by_amplitude += s.kind[beam] == 1;
      if (angle_deg > 45.0) ++outer, outer_by_phase += s.kind[beam] == 2;
    }
  }
  REQUIRE(nadir > 90);
  REQUIRE(outer > 700);
  // In much less noise than kernels/detect is tested in phase gains there too, and speckle decides which of the two.
  CHECK(nadir_by_amplitude > 0.2 * nadir);
  CHECK(outer_by_phase > 0.95 * outer);
}

TEST_CASE("the predicted standard deviations tell the scatter of depths") {
  const auto soundings = survey(shallow(), {.speed_mps = 3.0}, 3_s);
  for (const auto& [from, to] : {std::pair{15.0, 40.0}, {40.0, 62.0}}) {
    double squares = 0.0;
    int n = 0;
    for (const auto& s : soundings) {
      for (std::size_t beam = 0; beam < s.valid.size(); ++beam) {
        const double angle = std::abs(static_cast<double>(s.beam_angle_rad[beam]));
        if (s.valid[beam] == 0 || angle < from * MultibeamConfig::kDegree || angle > to * MultibeamConfig::kDegree)
          continue;
        const double across_m = 0.5 * s.travel_time_s[beam] * 1500.0 * std::tan(angle) * s.angle_sd_rad[beam];
        const double range_sd_m = std::hypot(static_cast<double>(s.range_sd_m[beam]), across_m);
        squares += std::pow(range_sd_m * std::cos(angle), 2), ++n;
      }
    }
    // As kernels/detect promises for a plane: within a factor of 1.5.
    const double ratio = depth_error(soundings, from, to).sd / std::sqrt(squares / n);
    INFO(from << " to " << to << " deg: " << ratio << " of the prediction, " << n << " soundings");
    CHECK(ratio < 1.5);
    CHECK(ratio > 1.0 / 1.5);
  }
}

namespace {

/// Mean strength of a level seabed in beams of 30-60 degrees by Lambert's law, dB.
double lambert_mu_db(const std::vector<msg::Soundings>& pings) {
  double sum = 0.0;
  int n = 0;
  for (const auto& s : pings) {
    for (std::size_t beam = 0; beam < s.valid.size(); ++beam) {
      const double angle = std::abs(static_cast<double>(s.beam_angle_rad[beam]));
      if (s.valid[beam] == 0 || angle < 30 * MultibeamConfig::kDegree || angle > 60 * MultibeamConfig::kDegree)
        continue;
      sum += std::pow(10.0, 0.1 * s.backscatter_strength_db[beam]) / std::pow(std::cos(angle), 2), ++n;
    }
  }
  REQUIRE(n > 400);
  return 10.0 * std::log10(sum / n);
}

}  // namespace

TEST_CASE("the backscattering strength of a level seabed is that of its law") {
  // Lambert's law with mu = -25 dB; a footprint as a rectangle, and an echo cut at its snippet's ends, are 0.5 dB.
  CHECK(lambert_mu_db(survey(shallow(), {.speed_mps = 3.0}, 2_s)) == Approx(-25.0).margin(0.5));
}

TEST_CASE("beams without a sounding say why, and what they did measure") {
  auto config = shallow();
  config.range_m = 40.0;  // the bottom at 60 deg
  const auto s = survey(config, {}, 500_ms).back();
  CHECK(s.flags[128] == 0);
  CHECK((s.flags[255] & msg::kSideLobe) != 0);
  CHECK(std::isnan(s.range_sd_m[255]));
  const auto cut_off = std::ranges::count_if(s.flags.flat(), [](std::uint8_t f) { return (f & msg::kCutOff) != 0; });
  CHECK(cut_off >= 2);

  config.source_level_db = -200.0;
  const auto silent = survey(config, {}, 500_ms).back();
  CHECK(silent.flags[128] == msg::kWeak);
  CHECK(std::isfinite(silent.quality_db[128]));  // noise was sampled: so far it stands above its median
}

TEST_CASE("motion during the ping does not disturb depths when the navigation is right") {
  const auto soundings = survey(shallow(), {.speed_mps = 3.0, .roll_rad = 0.1, .heave_m = 0.5, .depth_m = 1.0}, 5_s);
  const Spread port_and_starboard = depth_error(soundings, 0.0, 60.0);
  CHECK(std::abs(port_and_starboard.mean) < 0.01);
  CHECK(port_and_starboard.sd < 0.06);
}

TEST_CASE("a 1 m error in the measured lever arm shows as 1 m in the soundings") {
  auto wrong = shallow();
  wrong.mounting.measured.position_body_m = {0.0, 1.0, 0.0};  // starboard: east, as the bow is to north
  const auto right = survey(shallow(), {}, 500_ms), off = survey(wrong, {}, 500_ms);
  REQUIRE(right.size() == off.size());
  for (std::size_t beam = 0; beam < 256; ++beam) {
    CHECK(off[0].position_enu_m(beam, 0) - right[0].position_enu_m(beam, 0) == Approx(1.0).margin(1e-9));
    CHECK(off[0].position_enu_m(beam, 2) == Approx(right[0].position_enu_m(beam, 2)).margin(1e-9));
  }
}

namespace {

/// How far the swath is turned: by what the soundings of a beam near either edge tell, and by theory.
struct EdgeRoll {
  double found_rad, theory_rad;
};

/// Of each ping whose edges are heard, when the beams were steered against the roll of `latency_s` before transmission.
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

TEST_CASE("with ten degrees of roll the swath stays where it was steered, by what the motion sensor knew") {
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
      CHECK(edge.found_rad == Approx(edge.theory_rad).margin(0.3 * MultibeamConfig::kDegree));
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
    ++pings;  // the port edge looks up by as much: to 74 degrees at least, if it hears anything
    const double edge_rad = std::atan2(s.position_enu_m(0, 0), -s.position_enu_m(0, 2));
    turned += s.valid[0] == 0 || edge_rad < -73.0 * MultibeamConfig::kDegree;
  }
  CHECK(pings > 5);
  CHECK(turned == pings);
}

namespace {

/// Soundings with a probe at the face that tells 1 % more than 1500 m/s, and with none, of a head turned to starboard.
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

TEST_CASE("a wrong probe leaves the soundings of a level flat array right, for Snell's invariant is") {
  const auto [wrong, none] = wrong_probe_and_none(0.0);
  CHECK(wrong.back().applied.sound_speed_mps == 1515.0);
  CHECK(none.back().applied.sound_speed_mps == Approx(1500.0));
  for (const auto& [from, to] : {std::pair{-45.0, -15.0}, {-15.0, 15.0}, {15.0, 45.0}}) {
    // The same echoes a hundredth further out: 1000 and more soundings of 2 cm, so a mean to a millimetre.
    CHECK(std::abs(mean_depth_error(wrong, from, to) - mean_depth_error(none, from, to)) < 0.005);
  }
}

TEST_CASE("a wrong probe bends the swath of a tilted array as theory says") {
  const double tilt = -20.0 * MultibeamConfig::kDegree;  // about the bow: looks to starboard
  const auto [wrong, none] = wrong_probe_and_none(tilt);
  for (const double beam_deg : {25.0, 35.0}) {
    const double beam = beam_deg * MultibeamConfig::kDegree;
    // Where it really points, and where it is believed to; then at the refracted angle in the water of 1500 m/s.
    const double pointed = std::asin(std::sin(beam) * 1500.0 / 1515.0) - tilt, believed = beam - tilt;
    const double traced = std::asin(std::sin(believed) * 1500.0 / 1515.0);
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
    CHECK(a[ping].travel_time_s == b[ping].travel_time_s);  // what is heard is the same
    for (std::size_t beam = 0; beam < 256; ++beam) {
      REQUIRE(b[ping].position_enu_m(beam, 0) - a[ping].position_enu_m(beam, 0) == Approx(3.0).margin(1e-9));
      REQUIRE(b[ping].position_enu_m(beam, 1) - a[ping].position_enu_m(beam, 1) == Approx(-4.0).margin(1e-9));
    }
  }
}

TEST_CASE("without an estimate there are pings but no soundings") {
  Head head(shallow());
  for (SimTime t{0}; t <= 1_s; t += 10_ms) {
    msg::Pose pose;
    pose.stamp_ns = t.count();
    pose.enu_from_body = frames::wxyz_of(frames::enu_from_ned());
    head.give("pose", pose);
  }
  head.give("tile", flat_tile(-20.0));
  const auto soundings = head.step_until<msg::Soundings>("soundings", 1_s);
  REQUIRE(soundings.size() == 9);
  CHECK(valid_count(soundings.back()) == 0);
  CHECK(head.step_until<msg::Ping>("ping", 1_s).size() == 9);
}

TEST_CASE("the ping interval obeys 2 R / c plus dead time, always") {
  auto config = shallow();
  config.range_m = 120.0;
  config.dead_time_s = 0.004;
  Head head(config);
  give_motion(head, {}, 2_s);
  head.give("tile", flat_tile(-20.0));
  const auto shots = head.step_until<msg::Transmit>("transmit", 2_s);
  REQUIRE(shots.size() > 10);
  const std::int64_t least_ns = from_seconds(2 * 120.0 / 1500.0 + config.pulse_length_s + 0.004).count();
  for (std::size_t i = 1; i < shots.size(); ++i) CHECK(shots[i].stamp_ns - shots[i - 1].stamp_ns == least_ns);
}

TEST_CASE("auto range starts at the longest and settles beyond the swath's edge") {
  auto config = shallow();
  config.auto_range = true;
  config.range_m = 200.0;
  Head head(config);
  give_motion(head, {}, 3_s);
  head.give("tile", flat_tile(-20.0));
  const auto pings = head.step_until<msg::Ping>("ping", 3_s);
  REQUIRE(pings.size() > 10);
  CHECK(pings.front().applied.range_m == 200.0);
  const double edge_m = 20.0 / std::cos(65.0 * MultibeamConfig::kDegree);
  CHECK(pings.back().applied.range_m > edge_m * 1.03);
  CHECK(pings.back().applied.range_m < edge_m * 1.2);
  CHECK((pings.back().stamp_ns - pings[pings.size() - 2].stamp_ns) * 1e-9 == Approx(0.1));
}

TEST_CASE("a ping is published at its last echo plus the processing latency") {
  const MultibeamConfig config = shallow();
  Head head(config);
  give_motion(head, {}, 500_ms);
  head.give("tile", flat_tile(-20.0));
  head.run_until(400_ms);
  const auto packets = head.take("soundings");
  REQUIRE_FALSE(packets.empty());
  CHECK(packets[0].envelope.t_sim_ns == from_seconds(2 * 60.0 / 1500.0 + 100e-6).count() + 20'000'000);
}

TEST_CASE("the same ping twice has the same bytes, another seed has others") {
  const auto heard = [](std::uint64_t seed) {
    auto config = shallow();
    config.world.seed = seed;
    Head head(config);
    give_motion(head, {.speed_mps = 2.0, .roll_rad = 0.1}, 300_ms);
    head.give("tile", flat_tile(-20.0));
    return head.step_until<msg::Ping>("ping", 300_ms);
  };
  const auto a = heard(1), b = heard(1), other = heard(2);
  REQUIRE(a.size() == b.size());
  for (std::size_t i = 0; i < a.size(); ++i) CHECK(a[i].amplitude_upa == b[i].amplitude_upa);
  CHECK_FALSE(a[0].amplitude_upa == other[0].amplitude_upa);
}

TEST_CASE("beams beyond the range give no sounding, not the sidelobes of those within it") {
  auto config = shallow();
  config.range_m = 40.0;  // the bottom at 60 deg
  for (const auto& s : survey(config, {}, 1_s)) {
    for (std::size_t beam = 0; beam < 256; ++beam) {
      const double angle_deg = std::abs(s.beam_angle_rad[beam]) / MultibeamConfig::kDegree;
      if (angle_deg < 56.0) CHECK(s.valid[beam] == 1);
      if (angle_deg > 60.0) CHECK(s.valid[beam] == 0);
      if (s.valid[beam] == 1) CHECK(-s.position_enu_m(beam, 2) == Approx(20.0).margin(0.4));
      CHECK(std::isnan(s.travel_time_s[beam]) == (s.valid[beam] == 0));  // nobody takes it for a measurement
      CHECK(std::isnan(s.position_enu_m(beam, 2)) == (s.valid[beam] == 0));
    }
  }
}

TEST_CASE("commands change the next ping: range, power, pulse, gain, swath, rate and mode") {
  MultibeamConfig config = shallow();
  config.amplitude_every = 1000;
  Head head(config);
  give_motion(head, {}, 3_s);
  head.give("tile", flat_tile(-20.0));
  msg::SonarSettings wanted;
  wanted.stamp_ns = (1_s).count();
  wanted.range_m = 50.0;
  wanted.source_level_db = 205.0;
  wanted.pulse_length_s = 200e-6;
  wanted.gain_absorption_dbpm = 0.08;
  wanted.swath_rad = 90.0 * MultibeamConfig::kDegree;
  wanted.ping_rate_hz = 5.0;
  wanted.mode = "water_column";
  head.give("settings", wanted);
  const auto pings = head.step_until<msg::Ping>("ping", 3_s);
  const auto soundings = head.step_until<msg::Soundings>("soundings", 3_s);
  REQUIRE(pings.size() > 5);
  CHECK(pings[0].stamp_ns == 0);
  CHECK(pings[0].phase_rad.size() == 0);
  CHECK(pings[1].stamp_ns == (1100_ms).count());  // heard 100 ms later, from the next ping on: every one in this mode
  const msg::AppliedSettings& applied = pings[1].applied;
  CHECK(applied.range_m == 50.0);
  CHECK(applied.source_level_db == 205.0);
  CHECK(applied.pulse_length_s == 200e-6);
  CHECK(applied.gain_absorption_dbpm == 0.08);
  CHECK(applied.ping_rate_hz == 5.0);
  CHECK(applied.mode == "water_column");
  CHECK(pings[2].stamp_ns - pings[1].stamp_ns == (200_ms).count());
  CHECK(pings[1].phase_rad.size() == pings[1].amplitude_upa.size());
  CHECK(pings[1].track.pose_time_s.size() > 10);
  CHECK(static_cast<double>(pings[1].beam_angle_rad[255]) == Approx(45.0 * MultibeamConfig::kDegree));
  const double nadir_m = -soundings.back().position_enu_m(128, 2);
  CHECK(nadir_m == Approx(20.0).margin(0.05));
}

TEST_CASE("a range of 0 lets the head choose, one beyond the longest is clamped") {
  Head head(shallow());
  give_motion(head, {}, 2_s);
  head.give("tile", flat_tile(-20.0));
  msg::SonarSettings choose, far;
  choose.stamp_ns = (500_ms).count();
  choose.range_m = 0.0;
  far.stamp_ns = (1500_ms).count();
  far.range_m = 500.0;
  head.give("settings", choose, far);
  const auto soundings = head.step_until<msg::Soundings>("soundings", 2_s);
  const auto at = [&](SimTime t) {
    return std::ranges::find(soundings, t.count(), &msg::Soundings::stamp_ns)->applied.range_m;
  };
  CHECK(at(0_ms) == 60.0);
  CHECK(at(1400_ms) == Approx(1.13 * 20.0 / std::cos(65.0 * MultibeamConfig::kDegree)).margin(1.5));
  CHECK(at(1800_ms) == 60.0);
}

TEST_CASE("on a flat bottom the phase passes zero where the beam's axis meets it, and grows outward with time") {
  MultibeamConfig config = shallow();
  config.phase_every = 1;
  Head head(config);
  give_motion(head, {}, 300_ms);
  head.give("tile", flat_tile(-20.0));
  const auto pings = head.step_until<msg::Ping>("ping", 200_ms);
  const auto soundings = head.step_until<msg::Soundings>("soundings", 200_ms);
  REQUIRE(pings.size() == 1);
  const double per_s = 1.0 / pings[0].sample_period_s;
  double at = 0.0, later = 0.0, squares = 0.0;
  int n = 0;
  for (std::size_t beam = 200; beam < 240; ++beam) {  // 37 to 57 degrees to starboard
    const double echo_s = static_cast<double>(soundings[0].travel_time_s[beam]) + 0.5 * config.pulse_length_s;
    const auto k = static_cast<std::size_t>(std::lround(echo_s * per_s));
    const auto phase = pings[0].phase_rad.row(beam);
    at += static_cast<double>(phase[k]), later += static_cast<double>(phase[k + 3]);
    squares += std::pow(static_cast<double>(phase[k]), 2), ++n;
  }
  // 4 rad/m at 45 degrees (PHYSICS.md section 9): three samples of 3.75 cm are 0.45 rad; speckle scatters by 0.3 rad.
  CHECK(at / n == Approx(0.0).margin(0.15));
  CHECK(std::sqrt(squares / n) < 0.8);
  CHECK((later - at) / n == Approx(0.45).margin(0.2));
}

TEST_CASE("high density has more soundings than beams, equally spaced on the seabed, as right as the beams are") {
  MultibeamConfig config = shallow();
  config.beams = 128;
  config.spacing = MultibeamConfig::Spacing::kHighDensity;
  config.soundings = 400;
  const auto pings = survey(config, {.speed_mps = 3.0}, 1_s);
  const msg::Soundings& s = pings.back();
  REQUIRE(s.valid.size() == 400);
  REQUIRE(s.beam.size() == 400);
  CHECK(std::ranges::is_sorted(s.beam.flat()));
  CHECK(s.beam[399] == 127);
  CHECK(valid_count(s) > 390);
  const double step_m = 2.0 * 20.0 * std::tan(65.0 * MultibeamConfig::kDegree) / 399.0;
  double spacing = 0.0;
  int n = 0;
  for (std::size_t i = 1; i < 400; ++i) {
    if (s.valid[i] == 0 || s.valid[i - 1] == 0) continue;
    spacing += s.position_enu_m(i, 0) - s.position_enu_m(i - 1, 0), ++n;
  }
  CHECK(spacing / n == Approx(step_m).epsilon(0.02));
  for (const auto& [from, to] : {std::pair{0.0, 20.0}, {20.0, 45.0}, {45.0, 63.0}}) {
    const Spread error = depth_error(pings, from, to);
    INFO(from << " to " << to << " deg: mean " << error.mean << " m, sd " << error.sd << " m of " << error.count);
    CHECK(std::abs(error.mean) < 0.015);
    CHECK(error.sd < 0.04);
  }
}

TEST_CASE("a beam over the top of a wall detects both the wall and the seabed behind, if it may") {
  MultibeamConfig config = shallow();
  config.detections_per_beam = 3;
  Head head(config);
  give_motion(head, {}, 300_ms);
  head.give("tile",
            tile_of(256.0, 0.25, [](double east, double) { return std::abs(east - 15.0) < 0.2 ? -14.0 : -20.0; }));
  const auto s = head.step_until<msg::Soundings>("soundings", 300_ms).front();
  REQUIRE(s.detection.size() == s.valid.size());
  REQUIRE(s.valid.size() > 256);
  bool both = false;
  for (std::size_t i = 1; i < s.valid.size(); ++i) {
    if (s.detection[i] == 0) continue;
    REQUIRE(s.beam[i] == s.beam[i - 1]);
    CHECK(s.valid[i] == 1);
    CHECK(s.travel_time_s[i] > s.travel_time_s[i - 1]);
    // The wall's top edge is 20.5 m away, the seabed behind it some 29 m.
    both = both || (std::abs(s.position_enu_m(i - 1, 2) + 14.3) < 0.6 && std::abs(s.position_enu_m(i, 2) + 20.0) < 0.6);
  }
  CHECK(both);
}

TEST_CASE("with yaw stabilised the fans of sectors stay across the mean heading") {
  MultibeamConfig config = shallow();
  config.sectors = {{.frequency_hz = 290e3}, {.frequency_hz = 300e3}, {.frequency_hz = 310e3}};
  config.heading_mean_s = 1000.0;
  const double yaw = 5.0 * MultibeamConfig::kDegree;
  // A vehicle that was told to head north for long, and now heads 5 degrees to starboard of it.
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
    for (int i = -5; i < 5; ++i) {
      edges[0] += 0.1 * s.position_enu_m(static_cast<std::size_t>(43 + i), 1);
      edges[1] += 0.1 * s.position_enu_m(static_cast<std::size_t>(213 + i), 1);
    }
    return edges;
  };
  // Unstabilised the fan turns with the head: 18.9 m out it is 1.65 m off to the north (port) and the south.
  const auto turned = along_m(false), held = along_m(true);
  const double off_m = 20.0 * std::tan(43.3 * MultibeamConfig::kDegree) * std::sin(yaw);
  CHECK(turned[0] == Approx(off_m).epsilon(0.05));
  CHECK(turned[1] == Approx(-off_m).epsilon(0.05));
  CHECK(held[0] == Approx(0.0).margin(0.05));
  CHECK(held[1] == Approx(0.0).margin(0.05));
}

TEST_CASE("sectors of several frequencies, one after the other, see one flat seabed") {
  MultibeamConfig config = shallow();
  config.sectors = {
      {.frequency_hz = 280e3, .delay_s = 1e-3}, {.frequency_hz = 300e3, .delay_s = 2e-3}, {.frequency_hz = 320e3}};
  const auto pings = survey(config, {.speed_mps = 3.0}, 1_s);
  CHECK(valid_count(pings.back()) > 250);
  for (const auto& [from, to] : {std::pair{0.0, 15.0}, {15.0, 45.0}, {45.0, 62.0}}) {
    const Spread error = depth_error(pings, from, to);
    INFO(from << " to " << to << " deg: mean " << error.mean << " m, sd " << error.sd << " m of " << error.count);
    CHECK(std::abs(error.mean) < 0.02);
    CHECK(error.sd < 0.04);
  }
}

TEST_CASE("each sector's transmission is told with its own time and frequency, the earliest first") {
  MultibeamConfig config = shallow();
  config.sectors = {
      {.frequency_hz = 280e3, .delay_s = 1e-3}, {.frequency_hz = 300e3, .delay_s = 2e-3}, {.frequency_hz = 320e3}};
  Head head(config);
  give_motion(head, {}, 300_ms);
  head.give("tile", flat_tile(-20.0));
  const auto told = head.step_until<msg::Transmit>("transmit", 250_ms);
  REQUIRE(told.size() == 9);
  const double frequencies_hz[] = {320e3, 280e3, 300e3};
  for (std::size_t i = 0; i < told.size(); ++i) {
    const auto ping = static_cast<std::int64_t>(i / 3);
    CHECK(told[i].ping == ping);
    CHECK(told[i].frequency_hz == frequencies_hz[i % 3]);
    CHECK(told[i].stamp_ns == ping * 100'000'000 + static_cast<std::int64_t>(i % 3) * 1'000'000);
  }
}

TEST_CASE("a chirp finds the same flat seabed, and the same strength") {
  MultibeamConfig config = shallow();
  config.range_m = 50.0;
  config.beams = 128;
  config.chirp = true;
  config.pulse_length_s = 500e-6;
  config.bandwidth_hz = 20e3;  // c / 2B = 37.5 mm, 10 log BT = 10 dB
  config.sample_rate_hz = 40e3;
  const auto pings = survey(config, {.speed_mps = 3.0}, 1_s);
  CHECK(pings.back().applied.pulse == "fm_up");
  CHECK(pings.back().applied.bandwidth_hz == 20e3);
  for (const auto& [from, to] : {std::pair{0.0, 15.0}, {15.0, 45.0}, {45.0, 62.0}}) {
    const Spread error = depth_error(pings, from, to);
    INFO(from << " to " << to << " deg: mean " << error.mean << " m, sd " << error.sd << " m of " << error.count);
    CHECK(error.count > 200);
    CHECK(std::abs(error.mean) < 0.015);
    CHECK(error.sd < 0.04);
  }
  // What a snippet cuts off depends on the footprint, not on the pulse: a tone that resolves the same says the same.
  config.chirp = false;
  config.pulse_length_s = 50e-6;
  config.bandwidth_hz = 0.0;
  CHECK(lambert_mu_db(pings) == Approx(lambert_mu_db(survey(config, {.speed_mps = 3.0}, 1_s))).margin(0.2));
}
