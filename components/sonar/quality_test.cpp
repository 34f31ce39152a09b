#include "components/sonar/quality.h"

#include <catch2/catch.hpp>

#include "components/config/config_reader.h"

using namespace ensonify;

static Quality read(const std::string& yaml) {
  ConfigReader from = ConfigReader::from_text(yaml, "head.yaml");
  Quality quality = 0.25;
  quality.read(from, "quality");
  from.finish();
  return quality;
}

TEST_CASE("a quality is a factor of rays or the reference") {
  CHECK(read("{}") == Quality(0.25));  // left out, the default stays
  CHECK(read("quality: 2.5") == Quality(2.5));
  CHECK(read("quality: reference") == Quality::of_reference());
  CHECK(Quality::of_reference().rays == 4.0);
  CHECK(Quality(4.0) != Quality::of_reference());
}

TEST_CASE("a quality that is neither says what is allowed") {
  for (const char* wrong : {"quality: referense", "quality: [1]", "quality: {error_db: 0.1}", "quality: '1'"}) {
    CHECK_THROWS_WITH(read(wrong), "head.yaml:1:10: quality: must be a number from 0.05 to 10, or reference");
  }
  CHECK_THROWS_WITH(read("quality: 11"), "head.yaml:1:10: quality: 11 is outside [0.05, 10]");
}
