#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "components/echosounder/node.h"
#include "components/runtime/testing/node_under_test.h"
#include "components/sonar/testing/config.h"
#include "components/sonar/testing/mesh.h"
#include "components/sonar/testing/ping.h"
#include "components/sonar/testing/seabed.h"
#include "components/sonar/tile_set.h"
#include "kernels/acoustics/array/aperture.h"
#include "kernels/acoustics/array/line.h"
#include "kernels/seabed/backscatter.h"
#include "messages/motion.h"
#include "messages/navigation.h"
#include "scenarios/world/testing/default_yaml.h"

using namespace ensonify;
using Catch::WithinAbs;

namespace {

using Sounder = NodeUnderTest<EchosounderNode>;

/// In water of 1500 m/s and 0.05 dB/m over a Lambert seabed of -25 dB.
EchosounderConfig over_lambert() {
  EchosounderConfig config;
  world_of(config).water.profile.sound_speed_mps = 1500.0;
  world_of(config).water.absorption_dbpm = 0.05;
  world_of(config).seabed.sediments = {{0, seabed::Lambert{-25.0}}};
  config.range_m = 40.0;
  return config;
}

/// Bottom tracks and pings of half a second at rest, 2 m below the surface, `roll_rad` to starboard.
struct Survey {
  std::vector<msg::BottomTrack> bottom;
  std::vector<msg::Ping> pings;
  std::string health = "none";

  explicit Survey(const EchosounderConfig& config, const msg::Tile& tile, double roll_rad = 0.0) {
    Sounder sounder(config);
    for (SimTime t{0}; t <= 1500_ms; t += 20_ms) {
      msg::Pose pose;
      pose.stamp_ns = t.count();
      pose.position_enu_m = {0, 0, -2};
      pose.enu_from_body = frames::wxyz_of(frames::enu_from_body({0, 0, roll_rad}));
      sounder.give("pose", pose);
      msg::Estimate estimate;
      estimate.stamp_ns = t.count();
      estimate.position_enu_m = pose.position_enu_m;
      estimate.enu_from_body = pose.enu_from_body;
      sounder.give("estimate", estimate);
    }
    sounder.give("tile", tile);
    bottom = sounder.step_until<msg::BottomTrack>("bottom", 450_ms);
    pings = sounder.step_until<msg::Ping>("ping", 450_ms);
    const auto reported = sounder.step_until<msg::Health>("health", 1500_ms);
    if (!reported.empty()) health = reported.back().state + ": " + reported.back().message;
  }
};

msg::Tile flat(double height_m = -22.0) {
  return tile_of(128, 1.0, [=](double, double) { return height_m; });
}

}  // namespace

TEST_CASE("echosounder/default.yaml lists every parameter with its default") {
  CHECK(default_yaml_fault<EchosounderConfig>("echosounder", world_with("echosounder")) == "");
}

TEST_CASE("depth below the piston is right to a sample, also with roll within the beam") {
  const EchosounderConfig config = over_lambert();
  const double sample_m = 750.0 * config.sample_period_s();
  for (const double roll_deg : {0.0, 3.0}) {
    const Survey survey(config, flat(), roll_deg * EchosounderConfig::kDegree);
    REQUIRE(survey.bottom.size() == 4);
    REQUIRE(survey.pings.size() == 4);
    CHECK(survey.health == "ok: ");
    for (const auto& bottom : survey.bottom) {
      INFO("rolled by " << roll_deg << " degrees");
      CHECK(bottom.valid);
      CHECK_THAT(bottom.altitude_m, WithinAbs(20.0, 1.1 * sample_m));  // the first echo comes from straight below
    }
    CHECK(survey.pings[0].beam_angle_rad.size() == 1);
    CHECK(survey.pings[0].track.pose_position_enu_m(0, 2) == -2.0);
  }
}

TEST_CASE("a mesh above the seabed is the bottom while the head holds it") {
  const EchosounderConfig config = over_lambert();
  Sounder sounder(config);
  for (SimTime t{0}; t <= 1500_ms; t += 20_ms) {
    msg::Pose pose;
    pose.stamp_ns = t.count();
    pose.position_enu_m = {0, 0, -2};
    pose.enu_from_body = frames::wxyz_of(frames::enu_from_body({0, 0, 0}));
    sounder.give("pose", pose);
  }
  sounder.give("tile", flat());
  const auto strongest_m = [&](SimTime until) {  // of the newest ping: the track does not follow such a leap at once
    const auto pings = sounder.step_until<msg::Ping>("ping", until);
    REQUIRE(!pings.empty());
    const auto samples = pings.back().amplitude_upa.flat();
    const auto strongest = std::max_element(samples.begin(), samples.end()) - samples.begin();
    return 750.0 * config.sample_period_s() * static_cast<double>(strongest);
  };
  // Within 4 degrees the bottom is 0.05 m farther than straight below; the pulse is 0.075 m long, its samples half of
  // it.
  const double margin_m = 0.05 + 750.0 * (config.pulse_length_s + config.sample_period_s());
  CHECK_THAT(strongest_m(450_ms), WithinAbs(20.0, margin_m));
  sounder.give_at("mesh", 460_ms, table_of(60.0, -12.0));
  CHECK_THAT(strongest_m(950_ms), WithinAbs(10.0, margin_m));
  sounder.give_at("mesh_release", 960_ms, msg::MeshRelease{0});
  CHECK_THAT(strongest_m(1450_ms), WithinAbs(20.0, margin_m));
}

TEST_CASE("facet slopes stated by tiles count as those of the scenario") {
  const seabed::SedimentParameters silt = *seabed::sediment_of("medium silt");
  const auto received = [&](const seabed::Scatterer& sediment, const std::vector<double>& reported) {
    EchosounderConfig config = over_lambert();
    world_of(config).seabed.sediments = {{0, sediment}};
    msg::Tile tile = flat();
    tile.facet_mean_square_slope = msg::Array<double>::of(reported);
    return Survey(config, tile).pings;
  };
  constexpr double kSquare = 0.002;
  const auto reported = received(silt, {kSquare}), stated = received(seabed::MeshedSediment{silt, kSquare}, {}),
             plane = received(silt, {});
  REQUIRE(reported.size() == 4);
  for (std::size_t i = 0; i < reported.size(); ++i) {  // the first ping too
    CHECK(reported[i].amplitude_upa == stated[i].amplitude_upa);
    CHECK_FALSE(reported[i].amplitude_upa == plane[i].amplitude_upa);
  }
}

TEST_CASE("bottom echo energy equals the area integral, of both faces and tapered tones") {
  // Sum of p^2 dt = SL tau R^-4 sigma |b|^2 dA over the beam, on a flat seabed dA = H^2 dOmega / cos^3 of the angle
  // from the vertical. The rays' strata leave some 0.1 dB.
  using Face = EchosounderConfig::Face;
  for (const auto& [face, taper] : {std::pair{Face::kCircular, 0.0}, {Face::kSquare, 0.0}, {Face::kCircular, 0.5}}) {
    EchosounderConfig config = over_lambert();
    config.face = face;
    config.tapered_fraction = taper;
    config.effects.speckle = config.effects.noise = config.effects.multipath = false;
    // Two samples of a tapered tone bring its energy but for where they lie: over half a sample of depth that is no
    // more.
    double energy = 0.0;
    for (const double deeper_m : {0.0, 0.5 * 750.0 * config.sample_period_s()}) {
      const Survey survey(config, flat(-22.0 - deeper_m));
      for (const float a : survey.pings.at(0).amplitude_upa.flat()) {
        energy += 0.5 * double(a) * a * config.sample_period_s();
      }
    }

    const double waves = array::length_in_waves_for(config.beamwidth_rad);
    const double diameter = waves * 58.96 / 50.76;
    double expected = 0.0;
    constexpr double kStep = 0.002;
    for (double u = -0.4; u <= 0.4; u += kStep) {
      for (double v = -0.4; v <= 0.4; v += kStep) {
        const double cosine = std::sqrt(1.0 - u * u - v * v), range = 20.0 / cosine;
        const double b = face == Face::kCircular ? std::pow(array::piston_amplitude(diameter, std::hypot(u, v)), 2)
                                                 : array::line_power(waves, u) * array::line_power(waves, v);
        const double area = range * range / cosine * (kStep * kStep / cosine);
        expected += b * b * seabed::lambert_backscatter(-25.0, cosine) * area * std::pow(range, -4) *
                    std::pow(10.0, -0.2 * 0.05 * range);
      }
    }
    // The square of a raised cosine has a mean of 3/8.
    expected *= std::pow(10.0, 21.5) * config.pulse_length_s * (1.0 - 5.0 / 8.0 * taper);
    INFO("taper " << taper);
    CHECK_THAT(10.0 * std::log10(energy / expected), WithinAbs(0.0, 0.3));
  }
}

TEST_CASE("without speckle the ghost by the surface has the energy of pressures, 6 dB over one path") {
  // Alike in all directions. In the ghost, from 22 m on, a ring of seabed answers by two ways of one length, H and H +
  // 2 d high: 4 SL tau sigma dA / (R1 R2)^2. Rays leave 0.2 dB in 4 m of it.
  EchosounderConfig config = over_lambert();
  config.beamwidth_rad = 40.0 * EchosounderConfig::kDegree;  // whose rays go everywhere below
  config.effects.directivity = config.effects.speckle = config.effects.noise = false;
  const Survey both(config, flat());
  config.effects.multipath = false;
  const Survey direct(config, flat());
  for (const double from_m : {23.0, 29.0}) {
    const double to_m = from_m + 4.0;
    double energy = 0.0;
    for (auto k = static_cast<std::size_t>(from_m / 750.0 / config.sample_period_s());
         k < static_cast<std::size_t>(to_m / 750.0 / config.sample_period_s()); ++k) {
      const double with = double(both.pings.at(0).amplitude_upa[k]),
                   without = double(direct.pings.at(0).amplitude_upa[k]);
      energy += (with * with - without * without) * config.sample_period_s();
    }
    double expected = 0.0;
    constexpr double kStep_m = 0.001;
    const double half_pulse_m = 0.5 * 750.0 * config.pulse_length_s;
    for (double x = 0.5 * kStep_m; x < 60.0; x += kStep_m) {
      const double R1 = std::hypot(x, 20.0), R2 = std::hypot(x, 24.0), middle_m = 0.5 * (R1 + R2) + half_pulse_m;
      if (middle_m < from_m || middle_m >= to_m) continue;
      expected += 2.0 * std::numbers::pi * x * kStep_m * seabed::lambert_backscatter(-25.0, 20.0 / R1) /
                  std::pow(R1 * R2, 2) * std::pow(10.0, -0.1 * 0.05 * (R1 + R2));
    }
    expected *= 4.0 * std::pow(10.0, 21.5) * config.pulse_length_s;
    INFO("from " << from_m << " m");
    CHECK_THAT(10.0 * std::log10(energy / expected), WithinAbs(0.0, 0.3));
  }
}

TEST_CASE("a ping has the second echo: energy by images, and a tail that falls to the range's end") {
  // Seabed, surface, seabed: one leg direct, H high, the other H + 2 D high by the images of surface and seabed, 15 dB
  // lost in the mirror's bounce. Both orders by one pattern: 4 SL tau sigma b1 b2 dA / (R1 R2)^2. Rays leave 0.2 dB.
  EchosounderConfig config = over_lambert();
  config.range_m = 60.0;
  config.effects.speckle = config.effects.noise = false;
  const Survey both(config, flat());
  config.effects.multipath = false;
  const Survey direct(config, flat());
  const auto energy = [&](const Survey& survey, double from_m, double to_m) {
    double sum = 0.0;
    for (auto k = static_cast<std::size_t>(from_m / 750.0 / config.sample_period_s());
         k < static_cast<std::size_t>(to_m / 750.0 / config.sample_period_s()); ++k) {
      sum += std::pow(double(survey.pings.at(0).amplitude_upa[k]), 2) * config.sample_period_s();
    }
    return sum;
  };
  double expected = 0.0;
  constexpr double kStep_m = 0.001;
  const double diameter = array::length_in_waves_for(config.beamwidth_rad) * 58.96 / 50.76;
  for (double x = 0.5 * kStep_m; x < 40.0; x += kStep_m) {
    const double R1 = std::hypot(x, 20.0), R2 = std::hypot(x, 64.0);
    if (0.5 * (R1 + R2) > 59.5) break;
    const double b1 = std::pow(array::piston_amplitude(diameter, x / R1), 2),
                 b2 = std::pow(array::piston_amplitude(diameter, x / R2), 2);
    expected += 2.0 * std::numbers::pi * x * kStep_m * seabed::lambert_backscatter(-25.0, 20.0 / R1) * b1 * b2 /
                std::pow(R1 * R2, 2) * std::pow(10.0, -0.1 * 0.05 * (R1 + R2));
  }
  expected *= 4.0 * std::pow(10.0, 21.5 - 1.5) * config.pulse_length_s;
  CHECK_THAT(10.0 * std::log10((energy(both, 41.5, 59.5) - energy(direct, 41.5, 59.5)) / expected),
             WithinAbs(0.0, 0.3));
  // Beyond the main lobe, side lobes fall by a few dB from 2 m to the next; where rays end, echoes would.
  for (double from_m = 46.0; from_m < 58.0; from_m += 2.0) {
    INFO("from " << from_m << " m");
    CHECK(10.0 * std::log10(energy(both, from_m, from_m + 2.0) / energy(both, from_m - 2.0, from_m)) > -15.0);
  }
}

TEST_CASE("the surface overhead is received through the back of the piston only") {
  // EL = SL - 20 log L - alpha L - losses [Lurton2010]: up 2 m from a calm surface and down again, 40 dB less each way.
  EchosounderConfig config = over_lambert();
  config.effects.noise = false;
  const Survey survey(config, flat());
  const auto& amplitude = survey.pings.at(0).amplitude_upa;
  const auto last = static_cast<std::size_t>(2.0 * 10.0 / 1500.0 / config.sample_period_s());  // 10 m, above the bed
  const float strongest = *std::max_element(&amplitude[0], &amplitude[last]);
  CHECK_THAT(20.0 * std::log10(static_cast<double>(strongest)),
             WithinAbs(215.0 - 20.0 * std::log10(4.0) - 0.05 * 4.0 - 80.0, 0.1));  // a steady tone's level is exact
}

TEST_CASE("the surface overhead is never taken for the bottom, at any pulse length") {
  // Up 2 m and down again it stands 75 dB over the noise, for one pulse: the bottom, 20 m below, answers for longer.
  for (const double pulse_s : {100e-6, 1e-3}) {
    for (const double samples : {2.0, 20.0}) {
      EchosounderConfig config = over_lambert();
      config.pulse_length_s = pulse_s;
      config.samples_per_pulse = samples;
      const Survey survey(config, flat());
      INFO("pulse of " << pulse_s << " s, " << samples << " samples");
      REQUIRE(survey.pings.size() == 4);
      CHECK(survey.pings[0].sample_period_s == Approx(pulse_s / samples));
      const double sample_m = 750.0 * config.sample_period_s();
      for (const auto& bottom : survey.bottom) {
        CHECK(bottom.valid);
        // To a sample, and to the ray that is nearest to straight below.
        CHECK_THAT(bottom.altitude_m, WithinAbs(20.0, 1.1 * sample_m + 0.01));
      }
    }
  }
}

TEST_CASE("a pulse that a command makes longer is judged by its own length") {
  EchosounderConfig config = over_lambert();
  Echosounder head(config, 0);
  TileSet tiles;
  tiles.insert(flat());
  frames::PoseHistory at_rest(1'000'000'000);
  for (int i = 0; i <= 20; ++i) {
    at_rest.push(from_seconds(0.01 * i).count(), {{0, 0, -2}, frames::enu_from_body({0, 0, 0})});
  }
  HeadSettings settings = config.start();
  settings.pulse_length_s = 2e-3;  // 40 samples, 1.5 m
  const auto report = report_of(head, {0, SimTime{0}, settings.range_m}, settings, around(at_rest, tiles.scene()));
  const msg::BottomTrack bottom = std::get<1>(report.messages).value();
  CHECK(bottom.valid);
  CHECK_THAT(bottom.altitude_m, WithinAbs(20.0, 1.1 * 750.0 * config.sample_period_s()));
}

TEST_CASE("nearer than least_range_m nothing is taken for the bottom") {
  EchosounderConfig config = over_lambert();
  const auto seabed = flat(-3.5);  // 1.5 m below the piston
  const Survey usual(config, seabed);
  for (const auto& bottom : usual.bottom) CHECK_FALSE((bottom.valid && bottom.altitude_m < 2.0));
  config.least_range_m = 1.0;
  const Survey near(config, seabed);
  REQUIRE(near.bottom.size() == 4);
  for (const auto& bottom : near.bottom) {
    CHECK(bottom.valid);
    CHECK_THAT(bottom.altitude_m, WithinAbs(1.5, 1.1 * 750.0 * config.sample_period_s()));
  }
}

TEST_CASE("a range of more samples than a ping holds is refused with what is allowed") {
  CHECK(problems_of<EchosounderConfig>("pulse_length_s: 1.0e-5\nsamples_per_pulse: 20\nrange_m: 300\n") ==
        "head.yaml:3:10: range_m: makes 800020 samples; at most 600000 are allowed: shorten it or lower "
        "samples_per_pulse");
  CHECK(problems_of<EchosounderConfig>("samples_per_pulse: 1\n") ==
        "head.yaml:1:20: samples_per_pulse: 1 is outside [2, 20]");
  CHECK(problems_of<EchosounderConfig>("least_range_m: 0.5\n") ==
        "head.yaml:1:16: least_range_m: 0.5 is outside [1, 2000]");
}

TEST_CASE("a range below the altitude, and an echo below the noise, are said in health") {
  EchosounderConfig config = over_lambert();
  config.range_m = 15.0;
  CHECK(
      Survey(config, flat()).health ==
      "degraded: no seabed within the range of 15 m: the range is below the altitude, or the terrain has a hole here");
  config = over_lambert();
  config.source_level_db = -100.0;
  const Survey faint(config, flat());
  CHECK(faint.health == "degraded: no echo stands out of the water column: no depth");
  CHECK_FALSE(faint.bottom.at(0).valid);
}
