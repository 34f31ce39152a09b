#include "components/nav_out/node.h"

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <map>

#include "components/config/config_reader.h"
#include "components/config/read_parameters.h"
#include "components/formats/em_attitude/em_attitude.h"
#include "components/formats/tss1/tss1.h"
#include "components/runtime/testing/node_under_test.h"

using namespace ensonify;
using Catch::WithinAbs;

namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;
constexpr std::int64_t kStart_unix_ns = 1'748'779'199'600'000'000;  // 2025-06-01 11:59:59.6
const frames::Geodetic kOrigin{54.0, -3.0};
const frames::LocalProjection kWorld{kOrigin};

NavOutConfig config_of(const std::string& yaml) {
  ConfigReader from = ConfigReader::from_text(yaml, "out.yaml");
  NavOutConfig config;
  read_parameters<NavOutParameters>(from, config);
  from.finish();
  config.origin = kOrigin;
  config.start_unix_ns = kStart_unix_ns;
  return config;
}

/// East of the origin, where grid north is not true north, at 4 m/s on a heading of 30 degrees.
msg::Estimate estimate_at(SimTime t) {
  msg::Estimate estimate;
  estimate.stamp_ns = t.count();
  estimate.position_enu_m = {20'000.0 + 2.0 * seconds(t), 3.4641 * seconds(t), 0.5};
  estimate.velocity_enu_mps = {2.0, 3.4641, 0.0};
  estimate.enu_from_body = frames::wxyz_of(frames::enu_from_body({30.0 * kDegree, -2.0 * kDegree, 5.0 * kDegree}));
  return estimate;
}
msg::Position position_at(SimTime t) {
  msg::Position position;
  position.stamp_ns = t.count();
  position.position_enu_m = estimate_at(t).position_enu_m;
  const auto place = kWorld.geodetic_of({position.position_enu_m[0], position.position_enu_m[1]});
  position.latitude_deg = place.latitude_deg;
  position.longitude_deg = place.longitude_deg;
  position.sigma_horizontal_m = 0.02;
  position.sigma_vertical_m = 0.03;
  position.height_above_geoid_m = 1.25;
  position.geoid_above_ellipsoid_m = 50.5;
  return position;
}
msg::Attitude attitude_at(SimTime t) {
  msg::Attitude attitude;
  attitude.stamp_ns = t.count();
  attitude.roll_rad = 5.0 * kDegree;
  attitude.pitch_rad = -2.0 * kDegree;
  attitude.heading_grid_rad = 30.0 * kDegree;
  attitude.heave_m = 0.37;
  return attitude;
}
double true_heading_rad(SimTime t) {
  const auto place = estimate_at(t).position_enu_m;
  return 30.0 * kDegree + kWorld.convergence_rad({place[0], place[1]});
}

struct Left {
  SimTime at;
  std::string output, bytes;
};

/// Everything that leaves in so long a time.
std::vector<Left> run(const std::string& yaml, SimTime until, SimTime attitudes = 10_ms) {
  NodeUnderTest<NavOutNode> out(config_of(yaml));
  const auto takes = [&](const char* port) {
    for (const InPort& in : out.ports().ins()) {
      if (in.port == port) return true;
    }
    return false;
  };
  out.give_each("estimate", until, 10_ms, estimate_at);
  out.give_each("position", until, 100_ms, position_at);
  if (takes("attitude")) out.give_each("attitude", until, attitudes, attitude_at);
  if (takes("heading")) {
    out.give_each("heading", until, 100_ms, [](SimTime t) {
      msg::Heading heading;
      heading.stamp_ns = t.count();
      heading.heading_true_rad = 123.45 * kDegree;
      return heading;
    });
  }
  if (takes("altitude")) {
    out.give_each("altitude", until, 1_s, [](SimTime t) {
      msg::Altitude altitude;
      altitude.stamp_ns = t.count();
      altitude.valid = t != 2_s;
      altitude.range_m = 12.34;
      return altitude;
    });
  }
  std::vector<Left> all;
  for (const auto& sent : out.step_until<msg::FeedData>("sent", until)) {
    std::size_t at = 0;
    for (const msg::FeedPiece& piece : sent.pieces) {
      const auto* first = reinterpret_cast<const char*>(sent.bytes.data()) + at;
      all.push_back(
          {SimTime{sent.stamp_ns}, piece.source, std::string(first, static_cast<std::size_t>(piece.byte_count))});
      at += static_cast<std::size_t>(piece.byte_count);
    }
  }
  return all;
}
std::vector<Left> of_kind(const std::vector<Left>& all, const std::string& kind) {
  std::vector<Left> found;
  for (const Left& one : all) {
    if (one.bytes.find(kind + ",") != std::string::npos) found.push_back(one);
  }
  return found;
}
const std::string kFile = "file: " + (std::filesystem::temp_directory_path() / "nav_out_test.out").string();

}  // namespace

TEST_CASE("each sentence leaves at its rate, and says what the instrument measured") {
  const auto all = run(
      "outputs: { nav: { " + kFile + ", sentences: { GGA: 5, GST: 1, VTG: 1, HDT: 10, ROT: 1, PASHR: 50, DPT: 1 } } }",
      10_s);
  CHECK(of_kind(all, "GGA").size() == 51);
  CHECK(of_kind(all, "GST").size() == 11);
  CHECK(of_kind(all, "VTG").size() == 11);
  CHECK(of_kind(all, "HDT").size() == 101);
  CHECK(of_kind(all, "PASHR").size() == 501);
  CHECK(of_kind(all, "DPT").size() == 10);  // of eleven one had no answer
  const auto fix = std::get<nmea::Fix>(nmea::read_navigation(of_kind(all, "GGA")[7].bytes));
  const msg::Position position = position_at(1400_ms);  // 12:00:01.0
  CHECK_THAT(fix.time_s, WithinAbs(12 * 3600 + 1.0, 1e-6));
  CHECK_THAT(fix.latitude_deg, WithinAbs(position.latitude_deg, 1e-9));
  CHECK_THAT(fix.longitude_deg, WithinAbs(position.longitude_deg, 1e-9));
  CHECK(fix.quality == 4);
  CHECK_THAT(*fix.height_above_geoid_m + *fix.geoid_above_ellipsoid_m, WithinAbs(51.75, 1e-9));
  const auto motion = std::get<formats::Motion>(nmea::read_navigation(of_kind(all, "PASHR")[100].bytes));
  CHECK_THAT(*motion.roll_rad, WithinAbs(5.0 * kDegree, 1e-9));
  CHECK_THAT(*motion.pitch_rad, WithinAbs(-2.0 * kDegree, 1e-9));
  CHECK_THAT(*motion.heave_m, WithinAbs(0.37, 1e-9));
  CHECK_THAT(*motion.true_heading_rad, WithinAbs(true_heading_rad(2_s), 0.0051 * kDegree));
  const auto course = std::get<nmea::Course>(nmea::read_navigation(of_kind(all, "VTG")[5].bytes));
  CHECK_THAT(course.speed_mps, WithinAbs(4.0, 1e-3));
  CHECK_THAT(*course.true_course_rad, WithinAbs(true_heading_rad(5_s), 0.006 * kDegree));
  CHECK(of_kind(all, "HDT")[5].bytes.starts_with("$HEHDT,123.45,T"));  // the compass's own
  CHECK(of_kind(all, "ROT").back().bytes.starts_with("$TIROT,0.00,A"));
  CHECK(of_kind(all, "DPT")[0].bytes.starts_with("$SDDPT,12.34,,"));
}

TEST_CASE("ZDA leaves on its second of UTC, before all else; other sentences after the latency") {
  const auto all = run("outputs: { nav: { " + kFile + ", latency_s: 0.0335, sentences: { ZDA: 1, GGA: 10 } } }", 5_s);
  const auto times = of_kind(all, "ZDA");
  REQUIRE(times.size() == 5);
  for (std::size_t i = 0; i < times.size(); ++i) {
    CHECK(times[i].at == 400_ms + static_cast<int>(i) * 1_s);
    CHECK(times[i].bytes.starts_with("$GPZDA,12000" + std::to_string(i) + ".000,01,06,2025,"));
  }
  const auto fixes = of_kind(all, "GGA");
  CHECK(fixes.size() == 50);
  CHECK(fixes[3].at == 300_ms + SimTime{33'500'000});
}

TEST_CASE("formats of motion sensors leave as frames, true heading among them") {
  const auto all =
      run("outputs: { mru: { " + kFile + ", format: tss1, rate_hz: 25 }, em: { " + kFile +
              "2, format: em_attitude, rate_hz: 100 }, km: { " + kFile + "3, format: km_binary, rate_hz: 100 } }",
          4_s);
  std::map<std::string, std::vector<std::string>> by_output;
  for (const Left& one : all) by_output[one.output].push_back(one.bytes);
  CHECK(by_output["mru"].size() == 101);
  CHECK(by_output["em"].size() == 401);
  CHECK(by_output["km"].size() == 400);  // the first has no heave yet
  const auto bytes = [](const std::string& text) { return std::as_bytes(std::span(text)); };
  const auto tss1 = formats::tss1::read(bytes(by_output["mru"][50]));
  REQUIRE(tss1);
  CHECK(tss1->motion.usable);
  CHECK_THAT(*tss1->motion.roll_rad, WithinAbs(5.0 * kDegree, 1e-9));
  const auto em = formats::em_attitude::read(bytes(by_output["em"][50]));
  REQUIRE(em);
  CHECK_THAT(*em->motion.heave_m, WithinAbs(0.37, 1e-9));
  CHECK_THAT(*em->motion.true_heading_rad, WithinAbs(true_heading_rad(500_ms), 0.006 * kDegree));
  const auto km = formats::km_binary::read(bytes(by_output["km"][199]));
  REQUIRE(km);
  const auto motion = formats::km_binary::motion_of(*km);
  CHECK_THAT(*motion.time_s, WithinAbs(12 * 3600 + 1.6, 1e-6));
  CHECK_THAT(*motion.pitch_rad, WithinAbs(-2.0 * kDegree, 1e-7));
  CHECK_THAT(*motion.heave_m, WithinAbs(0.37, 1e-6));
  const auto place = formats::km_binary::place_of(*km);
  CHECK_THAT(place->latitude_deg, WithinAbs(position_at(2_s).latitude_deg, 1e-9));
  CHECK_THAT(place->ellipsoid_height_m, WithinAbs(51.75, 1e-4));
  CHECK_THAT(km->velocity_mps[0], WithinAbs(4.0 * std::cos(true_heading_rad(2_s)), 1e-3));
}

TEST_CASE("TSS1 and KM binary have the accelerations of the estimate's velocity") {
  nav_out::Instruments instruments(kStart_unix_ns, 1);
  instruments.set_origin(kOrigin);
  const auto bytes = [](const std::string& text) { return std::as_bytes(std::span(text)); };
  instruments.take(attitude_at(0_s));
  for (int n = 0; n <= 100; ++n) {
    msg::Estimate estimate = estimate_at(n * 10_ms);
    const double t_s = 0.01 * n;
    estimate.velocity_enu_mps = {0.3 * t_s, 0.4 * t_s, -0.25 * t_s};
    instruments.take(estimate);
  }
  const auto said = formats::tss1::read(bytes(instruments.say(nav_out::Kind::kTss1, {})));
  REQUIRE(said);
  CHECK_THAT(said->horizontal_acceleration_mps2, WithinAbs(0.5, 0.0383 / 2));
  CHECK_THAT(said->vertical_acceleration_mps2, WithinAbs(-0.25, 0.000625 / 2 + 1e-9));
  const auto km = formats::km_binary::read(bytes(instruments.say(nav_out::Kind::kKmBinary, {})));
  REQUIRE(km);
  const double true_rad = std::atan2(0.3, 0.4) + kWorld.convergence_rad({estimate_at(1_s).position_enu_m[0], 0.0});
  CHECK_THAT(km->acceleration_mps2[0], WithinAbs(0.5 * std::cos(true_rad), 1e-5));
  CHECK_THAT(km->acceleration_mps2[1], WithinAbs(0.5 * std::sin(true_rad), 1e-5));
  CHECK_THAT(km->acceleration_mps2[2], WithinAbs(0.25, 1e-6));
}

TEST_CASE("what the estimate knows badly is said to be invalid, in each format's way") {
  nav_out::Instruments instruments(kStart_unix_ns, 1);
  instruments.set_origin(kOrigin);
  const auto bytes = [](const std::string& text) { return std::as_bytes(std::span(text)); };
  const auto say_with = [&](double tilt_deg, double heading_deg) {
    msg::Estimate estimate = estimate_at(0_s);
    const double tilt = std::pow(tilt_deg * kDegree, 2), heading = std::pow(heading_deg * kDegree, 2);
    estimate.rotation_covariance_enu_rad2 = {tilt, 0, 0, 0, tilt, 0, 0, 0, heading};
    instruments.take(estimate);
    instruments.take(attitude_at(0_s));
    const auto psxn = std::get<nmea::MotionQuality>(nmea::read_navigation(instruments.say(nav_out::Kind::kPsxn20, {})));
    CHECK(formats::tss1::read(bytes(instruments.say(nav_out::Kind::kTss1, {})))->motion.usable == psxn.roll_and_pitch);
    CHECK(formats::em_attitude::read(bytes(instruments.say(nav_out::Kind::kEmAttitude, {})))->motion.usable ==
          psxn.roll_and_pitch);
    return psxn;
  };
  CHECK(say_with(0.02, 0.1).roll_and_pitch);
  CHECK(say_with(0.02, 0.1).heading);
  CHECK_FALSE(say_with(1.5, 0.1).roll_and_pitch);
  CHECK_FALSE(say_with(0.02, 5.0).heading);
  CHECK(say_with(0.02, 5.0).roll_and_pitch);
}

TEST_CASE("without a compass HDT has the heading of attitude, from true north") {
  nav_out::Instruments instruments(kStart_unix_ns, 1);
  instruments.set_origin(kOrigin);
  instruments.take(attitude_at(0_s));
  CHECK(instruments.say(nav_out::Kind::kHdt, {}).empty());  // where it is is not known yet
  instruments.take(estimate_at(0_s));
  instruments.take(attitude_at(10_ms));
  const auto heading = std::get<nmea::Heading>(nmea::read_navigation(instruments.say(nav_out::Kind::kHdt, {})));
  CHECK_THAT(heading.true_heading_rad, WithinAbs(true_heading_rad(10_ms), 0.0051 * kDegree));
}

TEST_CASE("other vessels report where they are, once for each instant, and none from the deep") {
  nav_out::Instruments instruments(kStart_unix_ns, 1);
  instruments.set_origin(kOrigin);
  nav_out::Vessels vessels({"tender", "tug"}, 970'000'002);
  CHECK(vessels.reports("ais", 1.0, instruments.earth()).empty());
  for (int n = 0; n <= 100; ++n) {
    vessels.take("tug", nav_out::motion_of(estimate_at(n * 10_ms)), instruments.earth());
    vessels.take("stranger", nav_out::motion_of(estimate_at(n * 10_ms)), instruments.earth());
    msg::Estimate deep = estimate_at(n * 10_ms);
    deep.position_enu_m[2] = -40.0;
    vessels.take("tender", nav_out::motion_of(deep), instruments.earth());
  }
  const auto reports = vessels.reports("ais", 1.0, instruments.earth());
  REQUIRE(reports.size() == 1);
  auto expected = nav_out::report_of(nav_out::motion_of(estimate_at(1_s)), {}, instruments.earth(), 970'000'003);
  expected.turn_rate_radps = 0.0;
  CHECK(reports[0] == formats::ais::vdm(expected));
  CHECK(expected.second == 0);
  CHECK(vessels.reports("ais", 1.0, instruments.earth()).empty());
}

TEST_CASE("a file has all that left, and the same run has the same bytes") {
  const auto folder = std::filesystem::temp_directory_path() / "nav_out_file_test";
  const auto text = [&] {
    NodeUnderTest<NavOutNode> out(
        config_of("outputs: { log: { file: out/nav.nmea, sentences: { ZDA: 1, GGA: 5, HDT: 5 } } }"), "test", folder);
    out.give_each("estimate", 3_s, 10_ms, estimate_at);
    out.give_each("position", 3_s, 100_ms, position_at);
    out.run_until(3_s);
    out.node().finish_run();
    std::ifstream file(folder / "out/nav.nmea");
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  const std::string first = text();
  CHECK(std::count(first.begin(), first.end(), '\n') == 3 + 16);
  CHECK(text() == first);
  std::filesystem::remove_all(folder);
}

TEST_CASE("nobody at the other end holds the run up, and what is lost is counted") {
  NodeUnderTest<NavOutNode> out(config_of("outputs: { nav: { tcp: 1, sentences: { GGA: 10 } } }"));
  out.give_each("position", 2_s, 100_ms, position_at);
  out.run_until(2_s);
  out.node().finish_run();
  out.run_until(4_s);
  std::map<std::string, std::int64_t> counts;
  for (const msg::Packet& packet : out.take("health")) {
    for (const auto& counter : msg::decode<msg::Health>(packet.body, packet.body.size()).counters)
      counts[counter.name] = counter.count;
  }
  CHECK(counts["sentences"] == 21);
  CHECK(counts["lost"] == 21);
}
