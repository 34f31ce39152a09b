// Objects in pings: target strengths in closed form, by the whole chain from the pager's message to the image.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "components/forward_looking/head.h"
#include "components/sonar/testing/config.h"
#include "components/sonar/testing/ping.h"
#include "components/sonar/testing/seabed.h"
#include "components/sonar/tile_set.h"
#include "components/terrain/object_message.h"

using namespace ensonify;
using Catch::WithinAbs;

namespace {

constexpr double kSpeed_mps = 1500.0, kAbsorption_dbpm = 0.05, kFrequency_hz = 300e3;
constexpr double kWave_m = kSpeed_mps / kFrequency_hz;

/// Tones so long that all of a target answers at once; sound travels straight.
ForwardLookingConfig quiet() {
  ForwardLookingConfig config;
  world_of(config).water.profile.sound_speed_mps = kSpeed_mps;
  world_of(config).water.absorption_dbpm = kAbsorption_dbpm;
  world_of(config).seabed.sediments = {{0, seabed::Lambert{-60.0}}, {1, seabed::Lambert{-10.0}}};
  config.process = "eye";
  config.frequency_hz = kFrequency_hz;
  config.beams = 65;  // one of them ahead
  config.pulse.length_s = 1e-3;
  config.pulse.chirp = false;
  config.range_m = 60.0;
  config.effects.noise = config.effects.multipath = false;
  return config;
}

/// North of the head, its upper side turned to it where it is a plate.
msg::Object object_at(const solids::Solid& solid, double range_m, bool smooth, double turn_deg = 0.0) {
  msg::Object object;
  object.name = "target";
  object.instance = object.class_id = 1;
  put_shape(solid, object);
  object.position_enu_m = {0.0, range_m, -10.0};
  Eigen::Matrix3d turn =
      Eigen::AngleAxisd(turn_deg * std::numbers::pi / 180.0, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  if (std::holds_alternative<solids::Plate>(solid))
    turn = turn * Eigen::AngleAxisd(0.5 * std::numbers::pi, Eigen::Vector3d::UnitX()).toRotationMatrix();
  if (std::holds_alternative<solids::Cylinder>(solid))  // its axis across
    turn = turn * Eigen::AngleAxisd(0.5 * std::numbers::pi, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  object.enu_from_object = frames::wxyz_of(frames::Quaternion(turn));
  object.smooth = smooth;
  object.sediment = 1;
  return object;
}

struct Sea {
  explicit Sea(const ForwardLookingConfig& of) : config(of), tiles(of.lod, kWave_m) {
    tiles.insert(tile_of(128.0, 1.0, [](double, double) { return -300.0; }));
    truth.push(0, {{0.0, 0.0, -10.0}, frames::enu_from_ned()});
  }
  msg::Ping ping(std::int64_t number = 0) {
    ForwardLooking head(config, 0);
    return image_of(head, {number, SimTime{0}, config.range_m}, config.start(),
                    around(truth, tiles.scene(), kSpeed_mps));
  }

  ForwardLookingConfig config;
  TileSet tiles;
  frames::PoseHistory truth{1'000'000'000};
};

/// Of the strongest sample, as a target strength: sonar equation on the axis, out and back.
double target_strength_db(const Sea& sea, const msg::Ping& ping, double range_m) {
  const auto all = ping.amplitude_upa.flat();
  const double peak = static_cast<double>(*std::ranges::max_element(all));
  return 20.0 * std::log10(peak) - sea.config.source_level_db + 40.0 * std::log10(range_m) +
         2.0 * kAbsorption_dbpm * range_m;
}

double smooth_db(const solids::Solid& solid, double range_m, double turn_deg = 0.0) {
  Sea sea(quiet());
  sea.tiles.insert(object_at(solid, range_m, true, turn_deg));
  return target_strength_db(sea, sea.ping(), range_m);
}

}  // namespace

TEST_CASE("smooth targets have their target strength in an image") {
  CHECK_THAT(smooth_db(solids::Sphere{0.3}, 30.0), WithinAbs(-22.5, 0.5));
  CHECK_THAT(smooth_db(solids::Plate{{0.2, 0.2}}, 40.0), WithinAbs(18.06, 0.5));
  CHECK_THAT(smooth_db(solids::Cylinder{0.1, 0.2}, 40.0), WithinAbs(-7.0, 0.5));
}

TEST_CASE("a plate that is turned fades as its lobe does") {
  // |sinc(2 L sin(turn) / lambda)|^2
  const double straight_db = smooth_db(solids::Plate{{0.2, 0.2}}, 40.0);
  for (const double turn_deg : {0.2, 0.4, 1.02}) {
    const double x = 2.0 * std::numbers::pi * 0.2 / kWave_m * std::sin(turn_deg * std::numbers::pi / 180.0);
    const double lobe_db = 20.0 * std::log10(std::abs(std::sin(x) / x));
    CHECK_THAT(smooth_db(solids::Plate{{0.2, 0.2}}, 40.0, turn_deg) - straight_db, WithinAbs(lobe_db, 1.0));
  }
}

TEST_CASE("without speckle a smooth target has the same level, and so it has from other rays") {
  Sea with(quiet());
  with.tiles.insert(object_at(solids::Sphere{0.3}, 30.0, true));
  const double db = target_strength_db(with, with.ping(), 30.0);
  ForwardLookingConfig config = quiet();
  config.effects.speckle = false;
  Sea without(config);
  without.tiles.insert(object_at(solids::Sphere{0.3}, 30.0, true));
  CHECK_THAT(target_strength_db(without, without.ping(), 30.0), WithinAbs(db, 0.1));
  for (const double quality : {0.25, 4.0}) {
    config = quiet();
    config.quality = quality;
    Sea other(config);
    other.tiles.insert(object_at(solids::Sphere{0.3}, 30.0, true));
    CHECK_THAT(target_strength_db(other, other.ping(), 30.0), WithinAbs(db, 0.01));
  }
}

TEST_CASE("a rough sphere has the mean level of Lambert's law over its lit half") {
  // So small that the beam is level over it. mu = 0.1: TS = 10 log10(0.1 * 2 pi a^2 / 3); over so long a pulse all of
  // it adds as energy.
  ForwardLookingConfig config = quiet();
  config.effects.speckle = false;
  Sea sea(config);
  sea.tiles.insert(object_at(solids::Sphere{0.1}, 30.0, false));
  CHECK_THAT(target_strength_db(sea, sea.ping(), 30.0),
             WithinAbs(10.0 * std::log10(0.1 * 2.0 * std::numbers::pi * 0.0025 / 3.0), 0.1));
}

TEST_CASE("what stands behind a wall is not there") {
  Sea sea(quiet());
  sea.tiles.insert(object_at(solids::Sphere{0.3}, 30.0, true));
  msg::Object wall = object_at(solids::Box{{4.0, 0.02, 4.0}}, 25.0, false);
  wall.number = 1;
  sea.tiles.insert(wall);
  const msg::Ping hidden = sea.ping();
  sea.tiles.release(msg::ObjectRelease{0});
  const msg::Ping alone = sea.ping();
  CHECK(std::ranges::equal(hidden.amplitude_upa.flat(), alone.amplitude_upa.flat()));
  sea.tiles.release(msg::ObjectRelease{1});
  const auto empty = sea.ping().amplitude_upa;
  CHECK(*std::ranges::max_element(empty.flat()) < 0.1F * *std::ranges::max_element(alone.amplitude_upa.flat()));
}
