#include "components/sonar/effects.h"

#include <catch2/catch.hpp>

#include "components/config/read_parameters.h"

using namespace ensonify;

namespace {

Effects effects_of(const std::string& yaml) {
  auto from = ConfigReader::from_text(yaml, "head.yaml");
  Effects effects;
  if (auto section = from.optional_section("effects")) read_parameters(*section, effects);
  from.finish();
  return effects;
}

}  // namespace

TEST_CASE("effects are on unless they are switched off, each by its name") {
  CHECK(effects_of("{}") == Effects{});
  for (const auto& [name, member] : {std::pair<std::string, bool Effects::*>{"refraction", &Effects::refraction},
                                     {"absorption", &Effects::absorption},
                                     {"directivity", &Effects::directivity},
                                     {"side_lobes", &Effects::side_lobes},
                                     {"speckle", &Effects::speckle},
                                     {"noise", &Effects::noise},
                                     {"volume", &Effects::volume},
                                     {"multipath", &Effects::multipath},
                                     {"motion", &Effects::motion},
                                     {"tvg", &Effects::tvg},
                                     {"quantisation", &Effects::quantisation}}) {
    Effects expected;
    expected.*member = false;
    INFO(name);
    CHECK(effects_of("effects: {" + name + ": false}") == expected);
  }
  CHECK_THROWS_WITH(effects_of("effects: {sidelobes: false}"),
                    Catch::Contains("effects.sidelobes: is not a known key"));
}
