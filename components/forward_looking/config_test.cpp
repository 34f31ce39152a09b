#include "components/forward_looking/config.h"

#include <catch2/catch.hpp>

#include "components/runtime/config/default_yaml.h"

using namespace ensonify;

namespace {

Scenario with_head(const std::string& name) {
  Scenario scenario;
  Vehicle auv;
  auv.name = "auv";
  auv.mountings[name] = {};
  scenario.vehicles = {auv};
  return scenario;
}

std::string problems(const std::string& yaml) {
  auto from = ConfigReader::from_text(yaml, "head.yaml");
  ForwardLookingConfig::read(from, with_head("eye"), "eye");
  try {
    from.finish();
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("forward_looking/default.yaml lists every parameter with its default") {
  CHECK(default_yaml_fault<ForwardLookingConfig>("forward_looking", with_head("forward_looking")) == "");
}

TEST_CASE("a head outside its limits is refused with place and limits") {
  CHECK(problems("beams: 4000") == "head.yaml:1:8: beams: 4000 is outside [16, 1024]");
  CHECK(problems("range_m: 200").find("is beyond longest_range_m, 120") != std::string::npos);
  CHECK(problems("{pulse: tone, bandwidth_hz: 50000}").find("only a chirp sweeps") != std::string::npos);
  CHECK(problems("effects: {noises: false}").find("noises: is not a known key") != std::string::npos);
  CHECK(problems("{frequency_hz: 1.2e6, beamwidth_deg: 0.6, bandwidth_hz: 300000}").empty());
}

TEST_CASE("with the gain switched off there is none to set") {
  ForwardLookingConfig config;
  config.effects.tvg = false;
  CHECK(config.start().gain_spreading_db == 0.0);
  CHECK_FALSE(config.limits().gain_spreading_db);
  config.effects.tvg = true;
  CHECK(config.start().gain_spreading_db == 30.0);
  CHECK(config.limits().gain_spreading_db->most == 80.0);
}
