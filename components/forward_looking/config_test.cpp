#include "components/forward_looking/config.h"

#include <catch2/catch.hpp>

#include "components/sonar/testing/config.h"
#include "scenarios/world/testing/default_yaml.h"

using namespace ensonify;

TEST_CASE("forward_looking/default.yaml lists every parameter with its default") {
  CHECK(default_yaml_fault<ForwardLookingConfig>("forward_looking", world_with("forward_looking")) == "");
}

TEST_CASE("a head outside its limits is refused with place and limits") {
  CHECK(problems_of<ForwardLookingConfig>("beams: 4000") == "head.yaml:1:8: beams: 4000 is outside [16, 1024]");
  CHECK(problems_of<ForwardLookingConfig>("range_m: 200").find("is beyond longest_range_m, 120") != std::string::npos);
  CHECK(problems_of<ForwardLookingConfig>("{pulse: tone, bandwidth_hz: 50000}").find("only a chirp sweeps") !=
        std::string::npos);
  CHECK(problems_of<ForwardLookingConfig>("effects: {noises: false}").find("noises: is not a known key") !=
        std::string::npos);
  CHECK(problems_of<ForwardLookingConfig>("{frequency_hz: 1.2e6, beamwidth_deg: 0.6, bandwidth_hz: 300000}").empty());
}

TEST_CASE("with the gain switched off there is none to set") {
  ForwardLookingConfig config;
  config.effects.tvg = false;
  CHECK(config.start().gain_spreading_db == 0.0);
  CHECK(config.limits().find("gain_spreading_db") == nullptr);
  config.effects.tvg = true;
  CHECK(config.start().gain_spreading_db == 30.0);
  CHECK(config.limits()["gain_spreading_db"].most == 80.0);
}
