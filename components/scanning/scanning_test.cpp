#include <catch2/catch.hpp>
#include <cmath>

#include "components/config/config_reader.h"
#include "components/runtime/testing/node_under_test.h"
#include "components/scanning/node.h"
#include "components/sonar/testing/config.h"
#include "components/sonar/testing/ping.h"
#include "kernels/acoustics/array/line.h"
#include "kernels/mesh/solids/solid.h"
#include "kernels/seabed/backscatter.h"
#include "messages/motion.h"
#include "messages/navigation.h"
#include "scenarios/world/testing/default_yaml.h"

using namespace ensonify;
using Catch::WithinAbs;

namespace {

constexpr double kDeg = Scan::kDegree;
constexpr double kSpeed_mps = 1500.0;

std::vector<double> angles_deg(const Scan& scan, int pings) {
  std::vector<double> angles;
  for (int ping = 0; ping < pings; ++ping) angles.push_back(scan_angle_rad(scan, ping) / kDeg);
  return angles;
}

void check_angles(const Scan& scan, const std::vector<double>& expected) {
  const auto found = angles_deg(scan, static_cast<int>(expected.size()));
  for (std::size_t i = 0; i < expected.size(); ++i) {
    INFO("ping " << i);
    CHECK_THAT(found[i], WithinAbs(expected[i], 1e-9));
  }
}

/// A quiet head over a Lambert seabed.
ScanningConfig quiet() {
  ScanningConfig config;
  world_of(config).water.profile.sound_speed_mps = kSpeed_mps;
  world_of(config).water.absorption_dbpm = 0.2;
  world_of(config).seabed.sediments = {{0, seabed::Lambert{-25.0}}};
  config.process = "eye";
  config.effects.noise = config.effects.multipath = config.effects.speckle = false;
  return config;
}

trace::Scene scene_of(const std::function<double(double, double)>& height_m) {
  trace::Scene scene({0, 0});
  scene.insert({0, 0},
               terrain::sample_tile({.origin_enu_m = {-64, -64}, .spacing_m = 0.25, .cells = 512}, {0, 0}, height_m));
  return scene;
}

double range_of(const msg::Ping& ping, std::size_t sample) {
  return 0.5 * kSpeed_mps * static_cast<double>(sample) * ping.sample_period_s;
}

}  // namespace

TEST_CASE("scanning/default.yaml lists every parameter with its default") {
  CHECK(default_yaml_fault<ScanningConfig>("scanning", world_with("scanning")) == "");
}

TEST_CASE("a scan outside its limits is refused with place and limits") {
  CHECK(problems_of<ScanningConfig>("steps_per_ping: 0") == "head.yaml:1:17: steps_per_ping: 0 is outside [1, 100]");
  CHECK(problems_of<ScanningConfig>("{sector_width_deg: 5, steps_per_ping: 10}")
            .find("is less than what the head turns") != std::string::npos);
  CHECK(problems_of<ScanningConfig>("{sector_width_deg: 90, turning: reversing}").empty());
}

TEST_CASE("a full turn goes round without a double place") {
  Scan scan;
  CHECK(pings_per_sweep(scan) == 400);
  check_angles(scan, {180.0, -179.1, -178.2});  // 180 and -180 are one direction
  CHECK(scan_angle_rad(scan, 399) / kDeg == Approx(179.1));
  CHECK(scan_angle_rad(scan, 400) == Approx(scan_angle_rad(scan, 0)));
  scan.steps_per_ping = 10;
  CHECK(pings_per_sweep(scan) == 40);
}

TEST_CASE("a sector is scanned from port to starboard, and again or back") {
  Scan scan{.centre_rad = 90 * kDeg, .width_rad = 4 * kDeg, .step_rad = 1 * kDeg};
  check_angles(scan, {88, 89, 90, 91, 92, 88, 89});
  scan.reversing = true;
  check_angles(scan, {88, 89, 90, 91, 92, 91, 90, 89, 88, 89});
  scan.steps_per_ping = 2;
  check_angles(scan, {88, 90, 92, 90, 88});
}

TEST_CASE("a pole echoes in the ping that points at it, at its range") {
  // 60 degrees to port, 12 m away; the head 10 m deep, 3 m above the seabed.
  const double east_m = -12.0 * std::sin(60 * kDeg), north_m = 12.0 * std::cos(60 * kDeg);
  ScanningConfig config = quiet();
  config.scan = {.centre_rad = -60 * kDeg, .width_rad = 20 * kDeg, .step_rad = 0.9 * kDeg};
  Scanning head(config, 0);
  frames::PoseHistory truth(1'000'000'000);
  truth.push(0, {{0.0, 0.0, -10.0}, frames::enu_from_ned()});
  auto scene = scene_of([&](double e, double n) { return std::hypot(e - east_m, n - north_m) < 0.2 ? -9.0 : -60.0; });
  double strongest_upa = 0.0, angle_deg = 0.0, range_m = 0.0;
  for (std::int64_t ping = 0; ping < pings_per_sweep(config.scan); ++ping) {
    const msg::Ping row = image_of(head, {ping, SimTime{0}, 20.0}, config.start(), around(truth, scene, kSpeed_mps));
    REQUIRE(row.amplitude_upa.rows() == 1);
    for (std::size_t k = 0; k < row.amplitude_upa.cols(); ++k) {
      if (static_cast<double>(row.amplitude_upa[k]) <= strongest_upa) continue;
      strongest_upa = static_cast<double>(row.amplitude_upa[k]);
      angle_deg = static_cast<double>(row.beam_angle_rad[0]) / kDeg;
      range_m = range_of(row, k);
    }
  }
  CHECK_THAT(angle_deg, WithinAbs(-60, 1.0));
  CHECK_THAT(range_m, WithinAbs(12.0, 0.5));  // a post of 0.4 m on posts of terrain 0.25 m apart
}

TEST_CASE("a shaded transducer keeps its -3 dB width and has the set side lobe level") {
  ScanningConfig config = quiet();
  config.shading = {array::Shading::Window::kTaylor, 30.0, 4};
  const auto at = [&](const array::Pattern& pattern, double sine) {
    const Eigen::Vector3d direction(std::sqrt(1.0 - sine * sine), sine, 0.0);
    return 20.0 * std::log10(std::abs(static_cast<double>(pattern.amplitude(direction.cast<float>(), 1.0F))) + 1e-9);
  };
  const array::Pattern shaded = scanning_pattern(config);
  CHECK_THAT(at(shaded, std::sin(1.0 * kDeg)) - at(shaded, 0.0), WithinAbs(-3.01, 0.05));
  // Null 1.189 lambda / L off the axis, L that of a uniform line; the highest side lobe at -30.3 dB
  // (docs/physics/acoustics/arrays.md), and what the face takes there is less than 0.1 dB.
  const double wave_over_length = 1.0 / array::length_in_waves_for(2.0 * kDeg);
  double highest_db = -100.0;
  for (double u = 1.25; u < 5.0; u += 0.01) highest_db = std::max(highest_db, at(shaded, u * wave_over_length));
  CHECK_THAT(highest_db, WithinAbs(-30.3, 0.2));
  config.effects.side_lobes = false;
  CHECK(scanning_pattern(config).amplitude({0.9F, static_cast<float>(1.25 * wave_over_length), 0.0F}, 1.0F) == 0.0F);
  CHECK(scanning_pattern(config).amplitude({0.9F, static_cast<float>(1.1 * wave_over_length), 0.0F}, 1.0F) != 0.0F);
}

TEST_CASE("the mean level of a flat seabed is that of the area integral") {
  // 5 m above it, tilted 10 degrees down. Ring between R and R + length: dA = R dR dphi.
  ScanningConfig config = quiet();
  config.tilt_rad = 10 * kDeg;
  config.range_m = 40.0;
  config.scan.centre_rad = config.scan.width_rad = 0.5 * kDeg;
  config.quality = 1.0;
  Scanning head(config, 0);
  frames::PoseHistory truth(1'000'000'000);
  truth.push(0, {{0.0, 0.0, -10.0}, frames::enu_from_ned()});
  auto scene = scene_of([](double, double) { return -15.0; });
  const msg::Ping row = image_of(head, {0, SimTime{0}, 40.0}, config.start(), around(truth, scene, kSpeed_mps));
  const double narrow = array::length_in_waves_for(2 * kDeg), tall = array::length_in_waves_for(25 * kDeg);
  const double length_m = 0.5 * kSpeed_mps * head.prepare(config.start()).ranged.length_s, H = 5.0;
  for (const double R : {15.0, 20.0, 30.0}) {
    double sum = 0.0;
    constexpr int kSteps = 40000;
    for (int i = 0; i < kSteps; ++i) {
      const double phi = -0.5 + (i + 0.5) / kSteps, ground = std::sqrt(R * R - H * H);
      const double x = ground / R * std::cos(phi), y = ground / R * std::sin(phi), z = H / R;
      const double one_way = array::line_power(narrow, y) *
                             array::line_power(tall, z * std::cos(config.tilt_rad) - x * std::sin(config.tilt_rad));
      sum += one_way * one_way / kSteps;
    }
    const double expected_db = config.source_level_db - 40.0 * std::log10(R) - 2.0 * 0.2 * R +
                               10.0 * std::log10(seabed::lambert_backscatter(-25.0, H / R) * R * length_m * sum);
    double mean_square = 0.0;
    int count = 0;
    for (std::size_t k = 0; k < row.amplitude_upa.cols(); ++k) {
      // The echo at time t is that of ranges from c (t - length) / 2 to c t / 2.
      if (std::abs(range_of(row, k) - 0.5 * length_m - R) > 0.5) continue;
      mean_square += static_cast<double>(row.amplitude_upa[k]) * static_cast<double>(row.amplitude_upa[k]);
      ++count;
    }
    INFO("range " << R);
    CHECK_THAT(10.0 * std::log10(mean_square / count), WithinAbs(expected_db, 0.5));
  }
}

TEST_CASE("a tapered tone keeps a flat seabed's mean level but for its effective length") {
  ScanningConfig config = quiet();
  config.tilt_rad = 10 * kDeg;
  config.range_m = 40.0;
  config.quality = 1.0;
  auto scene = scene_of([](double, double) { return -15.0; });
  frames::PoseHistory truth(1'000'000'000);
  truth.push(0, {{0.0, 0.0, -10.0}, frames::enu_from_ned()});
  const auto ping = [&] {
    Scanning head(config, 0);
    return image_of(head, {200, SimTime{0}, 40.0}, config.start(), around(truth, scene, kSpeed_mps));
  };
  const msg::Ping rectangular = ping();
  config.pulse.tapered_fraction = 0.5;
  const msg::Ping tapered = ping();
  CHECK(tapered.applied.pulse == "cw_tapered");
  CHECK(tapered.applied.tapered_fraction == 0.5);
  const auto level_db = [](const msg::Ping& row) {
    double sum = 0.0;
    for (std::size_t k = 0; k < row.amplitude_upa.cols(); ++k) {
      const double a = static_cast<double>(row.amplitude_upa[k]);
      if (range_of(row, k) > 12.0 && range_of(row, k) < 35.0) sum += a * a;
    }
    return 10.0 * std::log10(sum);
  };
  // The square of a raised cosine has a mean of 3/8: 1 - 5/8 of the tapered fraction is left.
  CHECK_THAT(level_db(tapered) - level_db(rectangular), WithinAbs(10.0 * std::log10(1.0 - 5.0 / 16.0), 0.2));
}

TEST_CASE("a command holds the tone and sets the sector's width") {
  ScanningConfig config = quiet();
  config.scan = {.width_rad = 90 * kDeg, .step_rad = 9 * kDeg};
  Scanning head(config, 0);
  frames::PoseHistory truth(1'000'000'000);
  truth.push(0, {{0.0, 0.0, -10.0}, frames::enu_from_ned()});
  auto scene = scene_of([](double, double) { return -15.0; });
  const auto ping = [&](std::int64_t number, double pulse_length_s, double swath_rad) {
    msg::SonarSettings wanted;
    wanted.pulse_length_s = pulse_length_s;
    wanted.swath_rad = swath_rad;
    CommandedSettings settings(config.start(), config.limits());
    settings.command(wanted);
    return image_of(head, {number, SimTime{0}, 20.0}, settings.at_ping(), around(truth, scene, kSpeed_mps));
  };
  const double by_range_s = 2 * 2 * 20.0 / kSpeed_mps / 1200;  // two of 1200 samples
  CHECK(ping(0, msg::kUnchanged, msg::kUnchanged).applied.pulse_length_s == Approx(by_range_s));
  CHECK(ping(0, 1e-3, msg::kUnchanged).applied.pulse_length_s == Approx(1e-3));
  CHECK(ping(0, 1e-3, msg::kUnchanged).sample_period_s == Approx(0.5e-3));
  CHECK(ping(0, 0.0, msg::kUnchanged).applied.pulse_length_s == Approx(by_range_s));

  const auto angle_deg = [&](std::int64_t number, double swath_deg) {
    return static_cast<double>(ping(number, msg::kUnchanged, swath_deg * kDeg).beam_angle_rad[0]) / kDeg;
  };
  CHECK(angle_deg(0, 90) == Approx(-45));
  CHECK(angle_deg(0, 36) == Approx(-18));
  CHECK(angle_deg(4, 36) == Approx(18));
  CHECK(angle_deg(5, 36) == Approx(-18));
  CHECK(angle_deg(1, 1) == Approx(4.5));  // no narrower than a step
}

TEST_CASE("pings carry their angle, and a head that can only see black says why") {
  ScanningConfig config;
  config.scan = {.width_rad = 90 * kDeg, .step_rad = 0.9 * kDeg, .steps_per_ping = 10, .reversing = true};
  config.quality = 0.1;
  config.range_m = 4.0;  // 5.333 ms, rounded up to whole samples of 16 us; 32 us of pulse and 20 ms of dead time
  NodeUnderTest<ScanningNode> head(config);
  for (SimTime t{0}; t <= 500_ms; t += 10_ms) {
    msg::Pose pose;
    pose.stamp_ns = t.count();
    pose.position_enu_m = {0.0, 0.0, -10.0};
    pose.enu_from_body = frames::wxyz_of(frames::enu_from_ned());
    head.give("pose", pose);
  }
  msg::Tile tile;
  tile.origin_east_m = tile.origin_north_m = -16.0;
  tile.spacing_m = 0.5;
  tile.height_m = msg::Array<float>({65, 65});
  for (float& h : tile.height_m.flat()) h = -15.0F;
  tile.sediment = msg::Array<std::uint8_t>({65, 65});
  head.give("tile", tile);
  const auto pings = head.step_until<msg::Ping>("ping", 450_ms);
  REQUIRE(pings.size() > 12);
  for (const msg::Ping& ping : pings) {
    CHECK(ping.beam_angle_rad[0] == static_cast<float>(scan_angle_rad(config.scan, ping.ping)));
    CHECK(ping.amplitude_upa.rows() == 1);
  }
  CHECK(static_cast<double>(pings[10].beam_angle_rad[0]) == Approx(45 * kDeg));
  CHECK(static_cast<double>(pings[11].beam_angle_rad[0]) == Approx(36 * kDeg));
  CHECK_THAT(pings[1].stamp_ns - pings[0].stamp_ns, WithinAbs(25'365'333, 20'000));
  const auto health = head.step_until<msg::Health>("health", 460_ms);
  REQUIRE_FALSE(health.empty());
  CHECK(health.back().message == "the range of 4.0 m is below the altitude of 5.0 m");
}

TEST_CASE("a body ahead has its mask and its shadow in the rows that point at it, and in no other") {
  ScanningConfig config = quiet();
  config.effects.noise = true;
  config.labels = LabelKind::kMasks;
  config.range_m = 20.0;
  trace::Scene scene = scene_of([](double, double) { return -13.0; });
  trace::Body body;  // a box 1 m high, 10 m to the north of the head, which is 3 m above the seabed
  body.surface = solids::surface_of(solids::Box{{2.0, 1.0, 1.0}}, 0.01);
  body.surface.mesh.origin_enu_m = {0.0, 10.0, -12.5};
  body.instance = 4;
  scene.insert_body(0, std::move(body));
  frames::PoseHistory truth{1'000'000'000};
  truth.push(0, {{0.0, 0.0, -10.0}, frames::enu_from_ned()});
  Scanning head(config, 0);
  const auto labels_of = [&](std::int64_t ping) {
    const auto report =
        report_of(head, {ping, SimTime{0}, config.range_m}, config.start(), around(truth, scene, kSpeed_mps));
    return std::get<1>(report.messages).value();
  };
  const msg::Labels ahead = labels_of(pings_per_sweep(config.scan) / 2);
  REQUIRE(ahead.objects.size() == 1);
  CHECK(ahead.objects[0].instance == 4);
  REQUIRE(ahead.mask_run.rows() > 0);
  const double metre = static_cast<double>(ahead.samples) / config.range_m;  // in samples, about
  CHECK_THAT(static_cast<double>(ahead.objects[0].box[1]) / metre, WithinAbs(std::hypot(9.5, 2.0), 0.1));
  CHECK_THAT(static_cast<double>(ahead.objects[0].shadow_box[3]) / metre, WithinAbs(std::hypot(15.75, 3.0), 0.1));
  const msg::Labels astern = labels_of(0);
  CHECK(astern.objects.empty());
  CHECK(astern.mask_run.empty());
}
