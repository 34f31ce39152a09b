// Pairs of pings, with a thing and without: bit for bit the same but for the samples of its echo and its shadow.
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "components/forward_looking/head.h"
#include "components/sonar/testing/config.h"
#include "components/sonar/testing/ping.h"
#include "components/sonar/testing/seabed.h"
#include "components/sonar/tile_set.h"
#include "components/terrain/object_message.h"

using namespace ensonify;

namespace {

constexpr double kSpeed_mps = 1490.0;
const frames::Vec3 kHead(0.0, 0.0, -10.0);

/// All effects but paths by way of the surface, which bring the thing's echoes once more, later.
ForwardLookingConfig config_of() {
  ForwardLookingConfig config;
  world_of(config).water.profile.samples = {{.depth_m = 0.0, .sound_speed_mps = 1500.0},
                                            {.depth_m = 12.0, .sound_speed_mps = 1490.0},
                                            {.depth_m = 40.0, .sound_speed_mps = 1470.0}};
  world_of(config).seabed.sediments = {{0, seabed::Lambert{-25.0}}, {1, seabed::Lambert{-15.0}}};
  config.process = "eye";
  config.beams = 64;
  config.range_m = 30.0;
  config.pulse.most_samples = 600;
  config.effects.multipath = false;
  return config;
}

/// A thing of 1 m over the seabed, 15 m from the head; another one on the seabed.
msg::Ping ping(bool smooth, bool absent) {
  const ForwardLookingConfig config = config_of();
  TileSet tiles(config.lod, kSpeed_mps / config.frequency_hz);
  tiles.insert(
      tile_of(96.0, 0.5, [](double east, double north) { return -22.0 + 0.2 * std::sin(east) - 0.01 * north; }));
  const auto insert = [&](std::int64_t number, const solids::Solid& solid, const frames::Vec3& at, bool gone) {
    msg::Object object;
    object.number = number;
    object.instance = number + 1;
    object.class_id = 1;
    put_shape(solid, object);
    object.position_enu_m = {at.x(), at.y(), at.z()};
    object.smooth = smooth;
    object.sediment = 1;
    object.absent = gone;
    tiles.insert(object);
  };
  insert(0, solids::Sphere{1.0}, {1.0, 12.0, -19.0}, absent);
  insert(1, solids::Box{{1.0, 1.0, 1.0}}, {-6.0, 20.0, -21.8}, false);
  frames::PoseHistory truth{10'000'000'000};
  truth.push(0, {kHead, frames::enu_from_ned()});
  ForwardLooking head(config, 0);
  return image_of(head, {0, SimTime{0}, config.range_m}, config.start(), around(truth, tiles.scene(), kSpeed_mps));
}

}  // namespace

TEST_CASE("a ping without a thing is the same to the bit, but where its echo and its shadow are") {
  for (const bool smooth : {false, true}) {
    const msg::Ping with = ping(smooth, false), without = ping(smooth, true);
    REQUIRE(with.amplitude_upa.shape() == without.amplitude_upa.shape());
    const auto shape = with.amplitude_upa.shape();
    int other = 0;
    double nearest_m = 1e9, farthest_m = 0.0;
    for (std::size_t beam = 0; beam < shape[0]; ++beam) {
      for (std::size_t sample = 0; sample < shape[1]; ++sample) {
        if (with.amplitude_upa(beam, sample) == without.amplitude_upa(beam, sample)) continue;
        const double range_m =
            0.5 * kSpeed_mps * (with.first_sample_s + static_cast<double>(sample) * with.sample_period_s);
        ++other;
        nearest_m = std::min(nearest_m, range_m), farthest_m = std::max(farthest_m, range_m);
      }
    }
    CHECK(other > 1000);
    // The sphere's near side is 14.54 m away. Rays past its upper side end within 21 m of the head on ground that is
    // 0.2 m rough. 0.5 m more for the pulse.
    CHECK(nearest_m > 14.0);
    CHECK(nearest_m < 15.0);
    CHECK(farthest_m > 16.0);
    CHECK(farthest_m < 22.0);
  }
}
