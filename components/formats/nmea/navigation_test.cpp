#include "components/formats/nmea/navigation.h"

#include <catch2/catch.hpp>
#include <string>

#include "components/formats/nmea/testing/sentence.h"

using namespace ensonify::nmea;

namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;

template <class T>
bool is(const Navigation& found) {
  return std::holds_alternative<T>(found);
}

}  // namespace

TEST_CASE("sentences as instruments send them are read") {
  // A receiver on a research vessel (GGA, HDT), and the manual of a positioning system (PASHR).
  const auto fix =
      std::get<Fix>(read_navigation("$INGGA,000000.16,2200.110899,S,01756.359432,W,1,12,0.7,-2.76,M,4.67,M,,*6C\r\n"));
  CHECK(fix.time_s == Approx(0.16));
  CHECK(fix.quality == 1);
  CHECK(fix.latitude_deg == Approx(-(22.0 + 0.110899 / 60.0)).epsilon(1e-12));
  CHECK(fix.longitude_deg == Approx(-(17.0 + 56.359432 / 60.0)).epsilon(1e-12));
  CHECK(fix.hdop == 0.7);
  CHECK(fix.height_above_geoid_m == -2.76);
  CHECK(std::get<Heading>(read_navigation("$INHDT,218.26,T*1A")).true_heading_rad == Approx(218.26 * kDegree));
  const auto motion =
      std::get<Motion>(read_navigation("$PASHR,163029.000,158.09,T,-0.30,+0.31,+0.01,0.029,0.029,0.059,1,1*3B\n"));
  CHECK(*motion.time_s == 16 * 3600 + 30 * 60 + 29);
  CHECK(*motion.true_heading_rad == Approx(158.09 * kDegree));
  CHECK(motion.roll_rad == Approx(-0.30 * kDegree));
  CHECK(motion.pitch_rad == Approx(0.31 * kDegree));
  CHECK(motion.heave_m == 0.01);
  const auto seapath = std::get<Motion>(read_navigation("$PSXN,23,0.35,-1.74,218.26,0.58*13"));
  CHECK_FALSE(seapath.time_s);
  CHECK(seapath.roll_rad == Approx(0.35 * kDegree));
  CHECK(*seapath.true_heading_rad == Approx(218.26 * kDegree));
  CHECK(seapath.heave_m == 0.58);
}

TEST_CASE("any talker is accepted; other sentences are known as such") {
  for (const char* talker : {"GP", "GN", "IN", "HE"}) {
    CHECK(is<Heading>(read_navigation(sentence(std::string(talker) + "HDT,1.0,T"))));
  }
  CHECK(is<Other>(read_navigation(sentence("INVTG,215.11,T,239.79,M,9.1,N,16.9,K,A"))));
  CHECK(is<Other>(read_navigation(sentence("PSXN,20,1,0,0,0"))));
}

TEST_CASE("a source without data yet is distinguished from a broken one") {
  CHECK(is<Empty>(read_navigation("$GPHDT,,T*1B")));
  CHECK(std::get<Fix>(read_navigation("$GPGGA,,,,,,0,,,,M,,M,,*66")).quality == 0);
  CHECK(is<Empty>(read_navigation(sentence("PASHR,,,T,,,,,,,0,0"))));
}

TEST_CASE("the sum is asked for, in either case") {
  CHECK(is<Heading>(read_navigation("$INHDT,218.26,T*1a")));
  CHECK(is<BadChecksum>(read_navigation("$INHDT,218.27,T*1A")));
  CHECK(is<BadChecksum>(read_navigation("$INHDT,218.26,T")));
  CHECK(is<BadChecksum>(read_navigation("$INHDT,218.26,T*1")));
  CHECK(is<BadChecksum>(read_navigation("$INHDT,218.26,T*ZZ")));
}

TEST_CASE("what cannot be is malformed, and never a place or an angle") {
  for (const char* body :
       {"INGGA,240000,2200.1,S,01756.3,W,1,12,0.7,-2.7,M,4.6,M,,",  // no such hour
        "INGGA,000000,9100.1,S,01756.3,W,1,12,0.7,-2.7,M,4.6,M,,",  // beyond the pole
        "INGGA,000000,2260.1,S,01756.3,W,1,12,0.7,-2.7,M,4.6,M,,",  // 60 minutes
        "INGGA,000000,2200.1,X,01756.3,W,1,12,0.7,-2.7,M,4.6,M,,",  // no such half
        "INGGA,000000,nan,S,01756.3,W,1,12,0.7,-2.7,M,4.6,M,,",     //
        "INGGA,000000,2200.1,S", "INHDT,361,T", "INHDT,inf,T", "INHDT,12.0,M", "INHDT,1e999,T",
        "PASHR,163029.000,158.09,T,-200,+0.31,+0.01", "PASHR,1630,158.09,T,0,0,0", "PSXN,23,0.35,-1.74,x,0.58"}) {
    CAPTURE(body);
    CHECK(is<Malformed>(read_navigation(sentence(body))));
  }
  for (const char* line : {"", "$", "hello", "!AIVDM,1*00", "\r\n"}) {
    CAPTURE(line);
    CHECK((is<Malformed>(read_navigation(line)) || is<BadChecksum>(read_navigation(line))));
  }
}
