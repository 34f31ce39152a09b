#include "components/feeds/log_player.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "components/formats/nmea/testing/sentence.h"

using namespace ensonify;

namespace {

std::string time_of(double t_s) {
  const int hundredths = static_cast<int>(std::lround(100.0 * t_s)), whole = hundredths / 100;
  char text[32];
  std::snprintf(text, sizeof text, "%02d%02d%02d.%03d", whole / 3600, whole / 60 % 60, whole % 60,
                10 * (hundredths % 100));
  return text;
}
std::string fix(double utc_s) {
  return nmea::sentence("GPGGA," + time_of(utc_s) + ",5312.6,N,00922.2,W,4,12,0.7,1.0,M,50,M,,");
}
std::string motion(double utc_s) {
  return nmea::sentence("PASHR," + time_of(utc_s) + ",90.00,T,+0.000,+0.00,+0.0000,0.1,0.1,0.1,1,1");
}
std::string heading() { return nmea::sentence("HEHDT,1.0,T"); }

/// When each line of a log comes, in a run whose first event is at 5 s.
std::vector<double> arrivals(const std::string& text) {
  const auto path = std::filesystem::temp_directory_path() / "ensonify_log_player_test.nmea";
  std::ofstream(path) << text;
  LogPlayer player(path);
  std::vector<double> found;
  for (int i = 0; i <= 2000; ++i) {
    while (const auto line = player.take(from_seconds(5.0 + 0.1 * i))) found.push_back(seconds(line->arrival));
  }
  std::filesystem::remove(path);
  return found;
}

}  // namespace

TEST_CASE("a log is played by its own times, across midnight; what has none comes with the line before") {
  CHECK(arrivals(fix(86398.0) + heading() + fix(86399.0) + heading() + fix(1.0)) ==
        std::vector<double>{5.0, 5.0, 6.0, 6.0, 8.0});
}

TEST_CASE("a leap second of a log lasts a second, and what has no time comes with it") {
  const auto at_leap = [](const std::string& tenth) { return motion(0.0).replace(7, 10, "235960." + tenth + "00"); };
  const auto framed = [](std::string line) { return nmea::sentence(line.substr(1, line.find('*') - 1)); };
  CHECK(arrivals(fix(86399.0) + framed(at_leap("0")) + heading() + framed(at_leap("5")) + fix(0.0) + fix(1.0)) ==
        std::vector<double>{5.0, 6.0, 6.0, 6.5, 7.0, 8.0});
}

TEST_CASE("a log that starts again goes on at once") {
  CHECK(arrivals(fix(100.0) + fix(101.0) + fix(50.0) + fix(51.0)) == std::vector<double>{5.0, 6.0, 6.0, 7.0});
}

TEST_CASE("sentences of one second in another order do not hold the log up") {
  CHECK(arrivals(fix(100.0) + fix(100.5) + motion(100.4) + fix(101.0)) == std::vector<double>{5.0, 5.5, 5.5, 6.0});
}

TEST_CASE("a log without a time is refused") {
  CHECK_THROWS_WITH(arrivals(heading() + heading()), Catch::Contains("no sentence of it has a time"));
  CHECK_THROWS_WITH(arrivals(""), Catch::Contains("no sentence of it has a time"));
}
