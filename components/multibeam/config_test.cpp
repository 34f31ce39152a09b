#include "components/multibeam/config.h"

#include <catch2/catch.hpp>

#include "components/runtime/config/default_yaml.h"

using namespace ensonify;

namespace {

Scenario with_head(const std::string& name) {
  Scenario scenario;
  Vehicle ship;
  ship.name = "ship";
  ship.mountings[name] = {};
  scenario.vehicles = {ship};
  return scenario;
}

std::string problems(const std::string& yaml) {
  auto from = ConfigReader::from_text(yaml, "head.yaml");
  MultibeamConfig::read(from, with_head("bow"), "bow");
  try {
    from.finish();
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("multibeam/default.yaml lists every parameter with its default") {
  CHECK(default_yaml_fault<MultibeamConfig>("multibeam", with_head("multibeam")) == "");
}

TEST_CASE("a head outside its limits is refused with place and limits") {
  CHECK(problems("frequency_hz: 5000") == "head.yaml:1:15: frequency_hz: 5000 is outside [50000, 1e+06]");
  CHECK(problems("rays_per_ping: 100").find("rays_per_ping: 100 is outside [20000, ") != std::string::npos);
  CHECK(problems("pulse_length_s: 0.00005").find("is below two samples per pulse, 40000") != std::string::npos);
  CHECK(problems("range_m: 1900").find("at most 20000 are allowed") != std::string::npos);
}

TEST_CASE("a head that no vehicle carries is refused") {
  auto from = ConfigReader::from_text("{}", "head.yaml");
  MultibeamConfig::read(from, with_head("bow"), "stern");
  CHECK_THROWS_WITH(from.finish(), Catch::Contains("mounts no head named stern"));
}

TEST_CASE("the water of the scenario sets speed, absorption and noise") {
  auto from = ConfigReader::from_text("frequency_hz: 300000", "head.yaml");
  const auto config = MultibeamConfig::read(from, with_head("bow"), "bow");
  CHECK(config.sound_speed_mps == Approx(1490.0).margin(1.0));   // 10 degC, 35 psu, surface [Mackenzie1981]
  CHECK(config.absorption_dbpm == Approx(0.0731).margin(2e-4));  // [Francois1982], printed for 300 kHz, 10 degC, 35 psu
  CHECK(config.noise_level_db == Approx(34.5).margin(0.1));      // [Mellen1952]
}
