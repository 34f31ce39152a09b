#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "components/errors/exit_error.h"
#include "components/formats/nmea/testing/sentence.h"
#include "components/tracks/track.h"

using namespace ensonify;
using namespace ensonify::tracks;
using Catch::WithinAbs;

namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;

/// A file of a test, gone at its end.
struct TestFile {
  std::string path =
      (std::filesystem::temp_directory_path() / ("ensonify_track_" + std::to_string(::getpid()))).string();
  explicit TestFile(const std::string& text) { std::ofstream(path, std::ios::binary) << text; }
  ~TestFile() { std::filesystem::remove(path); }
};

Track track_in(const std::string& text) { return read_track(TestFile(text).path); }

/// What is wrong with a text, without the file's name.
std::string fault_of(const std::string& text) {
  const TestFile file(text);
  try {
    read_track(file.path);
  } catch (const UserError& error) {
    const std::string what = error.what();
    return what.substr(what.find(file.path) == 0 ? file.path.size() : 0);
  }
  return "";
}

std::string gga(const std::string& time, const std::string& minutes) {
  return nmea::sentence("GPGGA," + time + ",4800." + minutes + ",N,00430.0000,W,4,12,0.7,3.0,M,46.0,M,,");
}

}  // namespace

TEST_CASE("a leap second of a log is a second of its own") {
  const Track track = track_in(gga("235959.00", "0001") + gga("235960.00", "0002") + gga("000000.00", "0003") +
                               gga("000001.00", "0004"));
  REQUIRE(track.fixes.size() == 4);
  for (std::size_t i = 1; i < 4; ++i) CHECK(track.fixes[i].ns - track.fixes[i - 1].ns == 1'000'000'000);
}

TEST_CASE("a table of geodetic places is read by the names of its columns") {
  const Track track = track_in(
      "# a comment\n"
      "time_s;Latitude;Longitude;Status;roll_deg;heading_deg\n"
      "10.0;48.5;-4.5;2;1.5;350\n"
      "11.5;48.50001;-4.5;2;;351\n");
  REQUIRE(track.fixes.size() == 2);
  CHECK(track.fixes[1].ns - track.fixes[0].ns == 1'500'000'000);
  CHECK(track.fixes[1].place.latitude_deg == 48.50001);
  CHECK(track.heading_rad.size() == 2);
  REQUIRE(track.roll_rad.size() == 1);
  CHECK_THAT(track.roll_rad[0].value, WithinAbs(1.5 * kDegree, 1e-12));
  CHECK(track.pitch_rad.empty());
}

TEST_CASE("a table of world places with UTC, depth and heave") {
  const Track track = track_in(
      "utc,east_m,north_m,depth_m,heave_m\n2025-06-01T12:00:00.25Z,1,2,3,0.1\n2025-06-01 12:00:01,4,5,6,0.2\n");
  REQUIRE(track.spots.size() == 2);
  CHECK(track.spots[1].ns - track.spots[0].ns == 750'000'000);
  CHECK(track.spots[1].place_enu_m == frames::Vec2(4, 5));
  CHECK(track.depth_m[1].value == 6.0);
  CHECK(track.heave_m[0].value == 0.1);
}

TEST_CASE("mistakes in a table have their line, the cause and what is allowed") {
  const std::string names = "time_s,east_m,north_m,roll_deg\n";
  CHECK(fault_of("time_s,east_m,north_m,rol_deg\n0,1,2,3\n") ==
        ":1: no column is named rol_deg; did you mean roll_deg?");
  CHECK_THAT(fault_of("time_s,speed\n0,1\n"),
             Catch::StartsWith(":1: the columns give no track; allowed: time_s or utc"));
  CHECK(fault_of(names + "0,1,2\n") == ":2: has 3 cells; allowed: 4, as there are columns");
  CHECK(fault_of(names + "0,1,2,95\n") == ":2: roll_deg is 95; allowed: -89 to 89");
  CHECK(fault_of(names + "0,1,,3\n") == ":2: north_m is empty; allowed: -1e+07 to 1e+07");
  CHECK(fault_of(names + "0,nan,2,3\n") == ":2: east_m is nan; allowed: -1e+07 to 1e+07");
  CHECK(fault_of(names + "1,1,2,3\n0.5,1,2,3\n") ==
        ":3: time runs back by 0.500 s; allowed: times that rise. Cut the file there");
  CHECK(fault_of("utc,east_m,north_m\nnoon,1,2\n") ==
        ":2: utc is \"noon\"; allowed: UTC such as 2025-06-01T12:00:00.5Z");
  CHECK(fault_of("") == ": is empty; allowed: a file with a track");
  CHECK_THAT(fault_of(std::string("\0\1\2\3,\n", 6)), Catch::StartsWith(": is of no known format; allowed: CSV"));
}

TEST_CASE("sentences without a time count by the stamps in front of their lines") {
  const Track track = track_in("2025-06-01T00:00:00.50Z " + gga("235959.00", "0000") + "2025-06-01T00:00:00.70Z " +
                               nmea::sentence("GPHDT,10.0,T") +  //
                               "2025-06-01T00:00:01.50Z " + gga("000000.00", "0010") + "2025-06-01T00:00:01.60Z " +
                               nmea::sentence("PSXN,23,1.0,-2.0,10.5,0.3"));
  REQUIRE(track.fixes.size() == 2);
  CHECK(track.fixes[1].ns - track.fixes[0].ns == 1'000'000'000);  // across midnight
  REQUIRE(track.heading_rad.size() == 1);
  CHECK(track.heading_rad[0].ns - track.fixes[0].ns == 200'000'000);
  REQUIRE(track.heave_m.size() == 1);
  CHECK(track.heave_m[0].ns - track.fixes[1].ns == 100'000'000);
  CHECK_THAT(track.pitch_rad[0].value, WithinAbs(-2.0 * kDegree, 1e-12));
}

TEST_CASE("without stamps they lie evenly between the sentences that have a time") {
  std::string log = gga("120000.00", "0000");
  for (int i = 0; i < 4; ++i) log += nmea::sentence("GPHDT,10." + std::to_string(i) + ",T");
  const Track track = track_in(log + gga("120001.00", "0010"));
  REQUIRE(track.heading_rad.size() == 4);
  for (int i = 0; i < 4; ++i) CHECK(track.heading_rad[static_cast<std::size_t>(i)].ns == i * 250'000'000);
}

TEST_CASE("RMC gives places only where no GGA does; bad sums and fixes of no quality do not count") {
  const std::string rmc = nmea::sentence("GPRMC,120000.50,A,4800.0005,N,00430.0000,W,5.0,0.0,010625,,,A");
  CHECK(track_in(rmc + gga("120000.00", "0000") + gga("120001.00", "0010")).fixes.size() == 2);
  CHECK(track_in(rmc + rmc).fixes.size() == 1);
  std::string broken = gga("120002.00", "0020");
  broken[20] = '9';
  CHECK(track_in(gga("120001.00", "0010") + broken).fixes.size() == 1);
  CHECK_THAT(fault_of(broken), Catch::StartsWith(": holds no fix; allowed: a log with GGA or RMC"));
}

TEST_CASE("a log whose time runs back, or that is on another datum, is refused with its line") {
  CHECK(fault_of(gga("120001.00", "0000") + gga("120000.00", "0010")) ==
        ":2: a fix's: time runs back by 1.000 s; allowed: times that rise. Cut the file there");
  CHECK(fault_of(nmea::sentence("GPDTM,999,,0,N,0,E,0,W84") + gga("120000.00", "0010")) ==
        ":1: fixes are on datum 999; allowed: W84");
}
