// Soundings of genuine files.
#include <catch2/catch.hpp>

#include "components/formats/testing/sample.h"
#include "tools/georeference/differences.h"

using namespace ensonify;
using namespace ensonify::georeference_tool;
using namespace ensonify::survey_files;

TEST_CASE("soundings of a genuine .kmall file are where it has them") {
  // Its probe said 1550 m/s where the profile has 1502: the sounder took the profile's. What is left, 8 mm of range and
  // 0.06 degrees, is not explained.
  const auto file = formats::sample::genuine("records/em2040p_eg.kmall");
  if (!file) {
    WARN("skipped: no data/records/em2040p_eg.kmall in the folder that ENSONIFY_SHARED names");
    return;
  }
  Differences as_is, by_face;
  const Summary summary =
      place_kmall(file->string(), {.surface_speed = false}, [&](const Placed& placed) { as_is.add(placed); });
  place_kmall(file->string(), {}, [&](const Placed& placed) { by_face.add(placed); });
  CHECK(summary.pings == 25);
  CHECK(summary.soundings == 11236);
  CHECK(summary.without_attitude == 990);  // of the two pings after the last attitude
  CHECK(as_is.vertical().p95_m < 0.03);
  CHECK(as_is.horizontal().p95_m < 0.03);
  CHECK(by_face.vertical().p95_m > 0.1);
}

TEST_CASE("soundings of a genuine .all file are where it has them") {
  // An EM 710 in 123 m of water, 250 m to either side.
  const auto file = formats::sample::genuine("records/em710_g_7041.all");
  if (!file) {
    WARN("skipped: no data/records/em710_g_7041.all in the folder that ENSONIFY_SHARED names");
    return;
  }
  Differences differences;
  const Summary summary = place_all(file->string(), {}, [&](const Placed& placed) { differences.add(placed); });
  CHECK(summary.soundings == 3106);
  CHECK(differences.vertical().p95_m < 0.05);
  CHECK(differences.horizontal().p95_m < 0.06);
}
