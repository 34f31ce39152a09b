#include "components/nav_feed/log_player.h"

#include <catch2/catch.hpp>
#include <filesystem>
#include <vector>

#include "components/nav_feed/testing/feed.h"

using namespace ensonify;
using namespace feed;

namespace {

/// When each line of a log comes, in a run whose first event is at 5 s.
std::vector<double> arrivals(const std::string& text) {
  const auto path = std::filesystem::temp_directory_path() / "ensonify_log_player_test.nmea";
  std::ofstream(path) << text;
  LogPlayer player(path);
  std::vector<double> found;
  for (int i = 0; i <= 2000; ++i) {
    while (const auto line = player.take(at_s(5.0 + 0.1 * i))) found.push_back(seconds(line->arrival));
  }
  std::filesystem::remove(path);
  return found;
}

}  // namespace

TEST_CASE("a log is played by its own times, across midnight; what has none comes with the line before") {
  CHECK(arrivals(fix(86398.0, 0, 0) + heading(1.0) + fix(86399.0, 0, 0) + heading(1.0) + fix(1.0, 0, 0)) ==
        std::vector<double>{5.0, 5.0, 6.0, 6.0, 8.0});
}

TEST_CASE("a leap second of a log lasts a second, and what has no time comes with it") {
  const auto at_leap = [](const std::string& tenth) {
    return motion_sentence(0.0, 0, 0).replace(7, 10, "235960." + tenth + "00");
  };
  const auto framed = [](std::string line) { return nmea::sentence(line.substr(1, line.find('*') - 1)); };
  CHECK(arrivals(fix(86399.0, 0, 0) + framed(at_leap("0")) + heading(1.0) + framed(at_leap("5")) + fix(0.0, 0, 0) +
                 fix(1.0, 0, 0)) == std::vector<double>{5.0, 6.0, 6.0, 6.5, 7.0, 8.0});
}

TEST_CASE("a log that starts again goes on at once") {
  CHECK(arrivals(fix(100.0, 0, 0) + fix(101.0, 0, 0) + fix(50.0, 0, 0) + fix(51.0, 0, 0)) ==
        std::vector<double>{5.0, 6.0, 6.0, 7.0});
}

TEST_CASE("sentences of one second in another order do not hold the log up") {
  CHECK(arrivals(fix(100.0, 0, 0) + fix(100.5, 0, 0) + motion_sentence(100.4, 0, 0) + fix(101.0, 0, 0)) ==
        std::vector<double>{5.0, 5.5, 5.5, 6.0});
}
