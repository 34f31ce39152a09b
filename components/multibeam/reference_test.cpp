// Pings of a quality against those of the reference: levels without speckle, so that nothing scatters but the rays. Of
// one ping at quality 1 the level of five degrees scatters by 0.2 dB at most, at nadir, where few ranges are resolved.
#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include "components/multibeam/head.h"
#include "components/multibeam/testing/head.h"
#include "components/sonar/testing/seabed.h"
#include "components/sonar/tile_set.h"

using namespace ensonify;

namespace {

/// 20 m of water with a thermocline over a slope, where a straight outer beam is 5 % wrong; no noise, no speckle.
MultibeamConfig under_a_thermocline(const Quality& quality) {
  MultibeamConfig config = head_in_plain_water();
  world_of(config).water.profile = WaterProfile{};
  for (const auto& [depth_m, speed_mps] : {std::pair{0.0, 1512.0}, {6.0, 1512.0}, {10.0, 1495.0}, {60.0, 1492.0}})
    world_of(config).water.profile.samples.push_back({.depth_m = depth_m, .sound_speed_mps = speed_mps});
  config.beams = 64;
  config.quality = quality;
  config.effects.speckle = config.effects.noise = config.effects.volume = config.effects.multipath = false;
  return config;
}

/// Mean square of each 5 degrees of beams over some pings, by their first degree.
std::map<int, double> levels(const Quality& quality) {
  const MultibeamConfig config = under_a_thermocline(quality);
  TileSet tiles;
  tiles.insert(tile_of(200.0, 0.5, [](double east, double) { return -22.0 + 0.03 * east; }));
  const Multibeam head(config, 0);
  const Steering steering = steer(config, config.swath_rad, {});
  std::map<int, double> sums;
  for (int ping = 0; ping < 24; ++ping) {
    frames::PoseHistory truth(1'000'000'000);
    frames::Pose pose;
    pose.position_enu_m = {0.0, 3.0 * ping, -2.0};
    truth.push(0, pose);
    Multibeam::Memory memory;
    const auto beams =
        receive_echoes(head, {ping, SimTime{0}, 60.0}, config.start(), steering, truth, tiles.scene(), memory);
    const detect::Amplitudes& image = beams.front().image;
    for (int beam = 0; beam < image.beams; ++beam) {
      const double angle_deg = double(steering.beam_angle_rad[std::size_t(beam)]) / MultibeamConfig::kDegree;
      double& sum = sums[5 * int(std::floor(angle_deg / 5.0))];
      for (int k = 0; k < image.samples; ++k) {
        const double amplitude =
            double(image.amplitude_upa[std::size_t(beam) * std::size_t(image.samples) + std::size_t(k)]);
        sum += amplitude * amplitude;
      }
    }
  }
  return sums;
}

}  // namespace

TEST_CASE("quality 1 has the level of the reference within 0.1 dB in each 5 degrees", "[long]") {
  const auto reference = levels(Quality::of_reference()), ordinary = levels(1.0);
  REQUIRE(reference.size() >= 24);
  for (const auto& [from_deg, level] : reference) {
    const double off_db = 10.0 * std::log10(ordinary.at(from_deg) / level);
    INFO(from_deg << " to " << from_deg + 5 << " deg: " << off_db << " dB");
    CHECK(std::abs(off_db) < 0.1);
  }
}
