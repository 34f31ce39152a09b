#include "components/formats/tide.h"

#include <catch2/catch.hpp>
#include <span>

#include "components/errors/exit_error.h"
#include "components/formats/testing/sample.h"

namespace ensonify::formats {
namespace {

constexpr std::int64_t kNoon = 1'773'144'000'000'000'000;  // 10 March 2026, 12:00:00 UTC
constexpr std::int64_t kMinute = 60'000'000'000;

Tide tide_of(const std::string& text) {
  const sample::TemporaryFile file(std::as_bytes(std::span(text)));
  return Tide(file.path().string());
}

}  // namespace

TEST_CASE("a tide is straight between its readings") {
  const Tide tide = tide_of("# gauge\nutc,level\n2026-03-10T12:00:00Z,1.5\n2026-03-10T12:10:00.0Z; -0.5\r\n\n");
  CHECK(tide.level_m(kNoon) == 1.5);
  CHECK(tide.level_m(kNoon + 5 * kMinute) == 0.5);
  CHECK(tide.level_m(kNoon + 10 * kMinute) == -0.5);
}

TEST_CASE("a tide file of CARIS is read") {
  const Tide tide = tide_of("--------\r\n2026/03/10 12:00:00 1.5\r\n2026/03/10 12:10:00 -0.5\r\n");
  CHECK(tide.level_m(kNoon + 5 * kMinute) == 0.5);
}

TEST_CASE("a byte order mark is no reading") {
  CHECK(tide_of("\xEF\xBB\xBF"
                "2026-03-10T12:00:00Z,1.5\n")
            .level_m(kNoon) == 1.5);
}

TEST_CASE("a tide says nothing before its first reading and after its last") {
  const Tide tide = tide_of("2026-03-10T12:00:00Z,1.5\n2026-03-10T12:10:00Z,2\n");
  CHECK_THROWS_WITH(tide.level_m(kNoon - 1), Catch::Contains("has no level for 2026-03-10T11:59:59Z"));
  CHECK_THROWS_AS(tide.level_m(kNoon + 10 * kMinute + 1), UserError);
}

TEST_CASE("a reading that is none is named with its line") {
  for (const char* line : {"2026-03-10 12:20:00,1", "2026-02-30T12:20:00Z,1", "2026-03-10T12:20:00Z,nan",
                           "2026-03-10T12:20:00Z", "2026-03-10T12:20:00Z,1 m", "2026-03-10T11:00:00Z,1"}) {
    INFO(line);
    CHECK_THROWS_WITH(tide_of(std::string("2026-03-10T12:00:00Z,1\n") + line + "\n"),
                      Catch::Contains(":2: is no reading"));
  }
  CHECK_THROWS_WITH(tide_of("2026-03-10T11:00:0OZ,5.0\n2026-03-10T12:00:00Z,1\n"),
                    Catch::Contains(":1: is no reading"));
  CHECK_THROWS_WITH(tide_of("time,level\n"), Catch::Contains("holds no reading"));
  CHECK_THROWS_WITH(Tide("none.csv"), Catch::Contains("--tide none.csv: cannot be read"));
}

}  // namespace ensonify::formats
