#include <catch2/catch.hpp>
#include <cmath>

#include "components/multibeam/testing/survey.h"
#include "components/sonar/environment.h"
#include "components/sonar/testing/seabed.h"
#include "kernels/water/refraction/eigenray.h"

// What the whole head finds of a seabed that is known: depths, strengths, and where it finds none.

using namespace ensonify;
using Catch::WithinAbs;

TEST_CASE("on a flat bottom depths are unbiased from nadir to the edge of the swath") {
  const auto soundings = survey(shallow(), {}, 3_s);
  REQUIRE(soundings.size() == 29);
  for (const auto& s : soundings) CHECK(valid_count(s) == 256);
  // Phase detection (kernels/acoustics/detect): under 0.05 % of depth to 60 degrees, 0.15 % to 70. The head rests, so
  // its pings share one speckle, and a mean is good to sd / sqrt(60 beams) only. Amplitude alone would scatter by 4 cm
  // outside.
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

TEST_CASE("in refracting water soundings lie on the flat bottom if the profile is known") {
  auto config = shallow();
  world_of(config).water.profile = warm_over_cold();
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
  world_of(config).water.profile = warm_over_cold();
  world_of(config).water.applied.sound_speed_mps = 1530.0;  // of the surface: right at the face, wrong below
  const auto error = [&](double angle_deg) {                // of the depth, by the exact ray of that beam
    const refraction::SoundSpeedProfile truth = true_profile(*config.world);
    const double depression = (90.0 - angle_deg) * MultibeamConfig::kDegree;
    const auto ray = refraction::path_to_depth(truth, 0.0, depression, 20.0);
    return ray->travel_time_s * 1530.0 * std::sin(depression) - 20.0;
  };
  REQUIRE(error(60.0) - error(10.0) < -0.5);  // the outer swath curls up by that
  const auto refracted = survey(config, {}, 1_s);
  world_of(config).water.applied = {};
  const auto right = survey(config, {}, 1_s);  // the same echoes: what detection errs cancels
  for (const auto& [from, to] : {std::pair{38.0, 42.0}, {53.0, 57.0}, {60.0, 64.0}}) {
    const double found = depth_error(refracted, from, to).mean - depth_error(right, from, to).mean;
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
  // In much less noise than kernels/acoustics/detect is tested in phase gains there too, and speckle decides which of
  // the two.
  CHECK(nadir_by_amplitude > 0.2 * nadir);
  CHECK(outer_by_phase > 0.95 * outer);
}

TEST_CASE("predicted standard deviations equal the scatter of depths") {
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
    // As kernels/acoustics/detect promises for a plane: within a factor of 1.5.
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
  CHECK_THAT(lambert_mu_db(survey(shallow(), {.speed_mps = 3.0}, 2_s)), WithinAbs(-25.0, 0.5));
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

TEST_CASE("beams beyond the range give no sounding, not the sidelobes of those within it") {
  auto config = shallow();
  config.range_m = 40.0;  // the bottom at 60 deg
  for (const auto& s : survey(config, {}, 1_s)) {
    for (std::size_t beam = 0; beam < 256; ++beam) {
      const double angle_deg = std::abs(s.beam_angle_rad[beam]) / MultibeamConfig::kDegree;
      if (angle_deg < 56.0) CHECK(s.valid[beam] == 1);
      if (angle_deg > 60.0) CHECK(s.valid[beam] == 0);
      if (s.valid[beam] == 1) CHECK_THAT(-s.position_enu_m(beam, 2), WithinAbs(20.0, 0.4));
      CHECK(std::isnan(s.travel_time_s[beam]) == (s.valid[beam] == 0));  // nobody takes it for a measurement
      CHECK(std::isnan(s.position_enu_m(beam, 2)) == (s.valid[beam] == 0));
    }
  }
}

TEST_CASE("on a flat bottom the phase is zero on the beam's axis and grows with time") {
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
  CHECK_THAT(at / n, WithinAbs(0.0, 0.15));
  CHECK(std::sqrt(squares / n) < 0.8);
  CHECK_THAT((later - at) / n, WithinAbs(0.45, 0.2));
}

TEST_CASE("high density gives more soundings than beams, equally spaced and as accurate") {
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

TEST_CASE("a beam over a wall's top detects wall and seabed where several detections may be") {
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

TEST_CASE("a tapered tone finds the same flat seabed, and the same strength") {
  MultibeamConfig config = shallow();
  config.range_m = 50.0;
  config.beams = 128;
  config.effects.speckle = false;  // else tones of another shape have other speckle
  const double rectangular_db = lambert_mu_db(survey(config, {.speed_mps = 3.0}, 1_s));
  config.tapered_fraction = 0.5;
  const auto pings = survey(config, {.speed_mps = 3.0}, 1_s);
  CHECK(pings.back().applied.pulse == "cw_tapered");
  CHECK(pings.back().applied.tapered_fraction == 0.5);
  // It brings 10 log(1 - 5/8 / 2) = 1.63 dB less energy.
  CHECK_THAT(lambert_mu_db(pings), WithinAbs(rectangular_db, 0.2));
  CHECK(std::abs(depth_error(pings, 0.0, 45.0).mean) < 0.015);
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
  CHECK_THAT(lambert_mu_db(pings), WithinAbs(lambert_mu_db(survey(config, {.speed_mps = 3.0}, 1_s)), 0.2));
}
