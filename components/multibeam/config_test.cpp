#include "components/multibeam/config.h"

#include <catch2/catch.hpp>

#include "components/sonar/testing/config.h"
#include "scenarios/world/testing/default_yaml.h"

using namespace ensonify;

TEST_CASE("multibeam/default.yaml lists every parameter with its default") {
  CHECK(default_yaml_fault<MultibeamConfig>("multibeam", world_with("multibeam")) == "");
}

TEST_CASE("a head outside its limits is refused with place and limits") {
  CHECK(problems_of<MultibeamConfig>("frequency_hz: 5000") ==
        "head.yaml:1:15: frequency_hz: 5000 is outside [50000, 1e+06]");
  CHECK(problems_of<MultibeamConfig>("quality: 0") == "head.yaml:1:10: quality: 0 is outside [0.05, 10]");
  CHECK(problems_of<MultibeamConfig>("pulse_length_s: 0.00005").find("is below two samples per pulse, 40000") !=
        std::string::npos);
  CHECK_THAT(
      problems_of<MultibeamConfig>("pulse: chirp\nbandwidth_hz: 5e4\nsample_rate_hz: 1e5\ntapered_fraction: 0.2"),
      Catch::Contains("tapered_fraction: is of tones; chirps have a window"));
  CHECK(problems_of<MultibeamConfig>("pulse: chirp\npulse_length_s: 0.0005\nbandwidth_hz: 20000")
            .find("is below two samples per 1 / bandwidth, 40000") != std::string::npos);
  CHECK(problems_of<MultibeamConfig>("pulse: chirp\nbandwidth_hz: 10000").find("a chirp needs at least 4") !=
        std::string::npos);
  CHECK(problems_of<MultibeamConfig>("bandwidth_hz: 10000").find("only a chirp sweeps") != std::string::npos);
  CHECK(problems_of<MultibeamConfig>("transmit_shading: {side_lobe_db: 5}") ==
        "head.yaml:1:34: transmit_shading.side_lobe_db: 5 is outside [13, 100]");
  CHECK(problems_of<MultibeamConfig>("receive_shading: {nbar: 2}") ==
        "head.yaml:1:25: receive_shading.nbar: 2 does not hold side lobes at side_lobe_db: 4 to 100 do");
  CHECK(problems_of<MultibeamConfig>("range_m: 1900").find("at most 20000 are allowed") != std::string::npos);
}

TEST_CASE("sectors take the head's frequency where they name none") {
  auto from = ConfigReader::from_text(
      "frequency_hz: 200000\nsectors: [{share: 2}, {frequency_hz: 210000, delay_s: 0.002}]", "head.yaml");
  const MultibeamConfig config = MultibeamConfig::read(from, world_with("bow"), "bow");
  from.finish();
  REQUIRE(config.sectors.size() == 2);
  CHECK(config.sectors[0].frequency_hz == 200e3);
  CHECK(config.sectors[1].frequency_hz == 210e3);
  CHECK(config.reception_s(75.0, 1e-4) == Approx(0.002 + 150.0 / config.sound_speed_mps + 1e-4));
  CHECK(problems_of<MultibeamConfig>("sectors: [{tilt_deg: 30}]").find("30 is outside [-20, 20]") != std::string::npos);
  CHECK(problems_of<MultibeamConfig>("spacing: high_density\nsoundings: 100").find("100 are fewer than the beams") !=
        std::string::npos);
}

TEST_CASE("a head that no vehicle carries is refused") {
  auto from = ConfigReader::from_text("{}", "head.yaml");
  MultibeamConfig::read(from, world_with("bow"), "stern");
  CHECK_THROWS_WITH(from.finish(), Catch::Contains("mounts no head named stern"));
}

TEST_CASE("the profile that the instrument applies turns range into time") {
  World world = world_with("bow");
  world.water.profile.sound_speed_mps = 1520.0;
  world.water.applied.sound_speed_mps = 1490.0;
  auto from = ConfigReader::from_text("{}", "head.yaml");
  CHECK(MultibeamConfig::read(from, world, "bow").sound_speed_mps == 1490.0);
}
