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
  CHECK(*motion.roll_rad == Approx(-0.30 * kDegree));
  CHECK(*motion.pitch_rad == Approx(0.31 * kDegree));
  CHECK(*motion.heave_m == 0.01);
  const auto seapath = std::get<Motion>(read_navigation("$PSXN,23,0.35,-1.74,218.26,0.58*13"));
  CHECK_FALSE(seapath.time_s);
  CHECK(*seapath.roll_rad == Approx(0.35 * kDegree));
  CHECK(*seapath.true_heading_rad == Approx(218.26 * kDegree));
  CHECK(*seapath.heave_m == -0.58);
}

TEST_CASE("speeds, turn rates, dates, accuracies and depths are read in their units") {
  // A receiver on a research vessel (RMC, VTG, ZDA) and its echo sounder (DPT).
  const auto rmc = std::get<MinimumFix>(
      read_navigation("$INRMC,000000.16,A,2200.110899,S,01756.359432,W,9.1,215.11,010814,24.7,W,A*3B"));
  CHECK(rmc.fix.quality == 1);
  CHECK(rmc.fix.latitude_deg == Approx(-(22.0 + 0.110899 / 60.0)).epsilon(1e-12));
  CHECK(*rmc.date == std::chrono::sys_days(std::chrono::year(2014) / 8 / 1));
  CHECK(rmc.course->speed_mps == Approx(9.1 * 0.514444).epsilon(1e-6));
  CHECK(*rmc.course->true_course_rad == Approx(215.11 * kDegree));
  const auto vtg = std::get<Course>(read_navigation("$INVTG,215.11,T,239.79,M,9.1,N,16.9,K,A*05"));
  CHECK(vtg.speed_mps == rmc.course->speed_mps);
  const auto zda = std::get<DateAndTime>(read_navigation("$INZDA,000000.17,01,08,2014,,*7E"));
  CHECK(zda.time_s == Approx(0.17));
  CHECK(zda.date == *rmc.date);
  const auto dpt = std::get<WaterDepth>(read_navigation("$KIDPT,4674.70,8.62,12000.0*79"));
  CHECK(dpt.below_transducer_m == 4674.70);
  CHECK(*dpt.offset_m == 8.62);
  const auto dbt = std::get<WaterDepth>(read_navigation(sentence("SDDBT,15.0,f,4.57,M,2.5,F")));
  CHECK(dbt.below_transducer_m == 4.57);
  CHECK_FALSE(dbt.offset_m);
  CHECK(std::get<Heading>(read_navigation(sentence("GPTHS,77.52,A"))).true_heading_rad == Approx(77.52 * kDegree));
  CHECK(std::get<TurnRate>(read_navigation(sentence("TIROT,-30.0,A"))).rate_radps == Approx(-0.5 * kDegree));
  const auto gst =
      std::get<FixAccuracy>(read_navigation(sentence("GPGST,172814.0,0.006,0.023,0.020,273.6,0.023,0.020,0.031")));
  CHECK(gst.latitude_m == 0.023);
  CHECK(gst.longitude_m == 0.020);
  CHECK(*gst.height_m == 0.031);
  const auto vbw = std::get<TwoSpeeds>(read_navigation(sentence("VDVBW,12.3,0.05,A,12.4,-0.1,V")));
  CHECK(*vbw.water_ahead_mps == Approx(12.3 * 0.514444).epsilon(1e-6));
  CHECK_FALSE(vbw.ground_ahead_mps);
  CHECK(std::get<Datum>(read_navigation(sentence("GPDTM,W72,,0.0,N,0.0,E,0.0,W84"))).code == "W72");
  const auto quality = std::get<MotionQuality>(read_navigation("$PSXN,20,1,0,0,0*3A"));
  CHECK((quality.heave && quality.roll_and_pitch && quality.heading));
}

TEST_CASE("a blank roll, pitch or heave is blank, not zero") {
  const auto one_baseline = std::get<Motion>(read_navigation(sentence("PSAT,HPR,170128.00,277.29,-0.75,,N")));
  CHECK(*one_baseline.time_s == 17 * 3600 + 60 + 28);
  CHECK(*one_baseline.true_heading_rad == Approx(277.29 * kDegree));
  CHECK(*one_baseline.pitch_rad == Approx(-0.75 * kDegree));
  CHECK_FALSE(one_baseline.roll_rad);
  CHECK_FALSE(one_baseline.heave_m);
  const auto pashr =
      std::get<Motion>(read_navigation(sentence("PASHR,163029.000,158.09,T,-0.30,,,0.029,0.029,0.059,1,1")));
  CHECK(pashr.roll_rad);
  CHECK_FALSE(pashr.pitch_rad);
  CHECK_FALSE(pashr.heave_m);
}

TEST_CASE("what a mode or status calls invalid is not read as data") {
  CHECK(is<Empty>(read_navigation(sentence("GPTHS,77.52,V"))));
  CHECK(is<Empty>(read_navigation(sentence("TIROT,-30.0,V"))));
  CHECK(is<Empty>(read_navigation(sentence("GPVTG,,T,,M,0.0,N,0.0,K,N"))));
  CHECK(std::get<MinimumFix>(read_navigation(sentence("GPRMC,,V,,,,,,,,,,N"))).fix.quality == 0);
  CHECK_FALSE(std::get<MotionQuality>(read_navigation(sentence("PSXN,20,0,0,0,2"))).roll_and_pitch);
  CHECK_FALSE(std::get<MotionQuality>(read_navigation(sentence("PSXN,20,0,0,2,0"))).heading);
  CHECK_FALSE(std::get<Course>(read_navigation(sentence("GPVTG,,T,,M,0.0,N,0.0,K,A"))).true_course_rad);
}

TEST_CASE("any talker is accepted; other sentences are known as such") {
  for (const char* talker : {"GP", "GN", "IN", "HE"}) {
    CHECK(is<Heading>(read_navigation(sentence(std::string(talker) + "HDT,1.0,T"))));
  }
  CHECK(is<Other>(read_navigation(sentence("INXDR,C,12.0,C,AIR"))));
  CHECK(is<Other>(read_navigation(sentence("PSXN,22,0.03,-0.80"))));
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
  for (const char* body : {"INGGA,240000,2200.1,S,01756.3,W,1,12,0.7,-2.7,M,4.6,M,,",  // no such hour
                           "INGGA,000000,9100.1,S,01756.3,W,1,12,0.7,-2.7,M,4.6,M,,",  // beyond the pole
                           "INGGA,000000,2260.1,S,01756.3,W,1,12,0.7,-2.7,M,4.6,M,,",  // 60 minutes
                           "INGGA,000000,2200.1,X,01756.3,W,1,12,0.7,-2.7,M,4.6,M,,",  // no such half
                           "INGGA,000000,nan,S,01756.3,W,1,12,0.7,-2.7,M,4.6,M,,",     //
                           "INGGA,000000,2200.1,S",
                           "INHDT,361,T",
                           "INHDT,inf,T",
                           "INHDT,12.0,M",
                           "INHDT,1e999,T",
                           "PASHR,163029.000,158.09,T,-200,+0.31,+0.01",
                           "PASHR,1630,158.09,T,0,0,0",
                           "PSXN,23,0.35,-1.74,x,0.58",
                           "GPRMC,000000,A,2200.1,S,01756.3,W,9.1,400,010814,,",
                           "GPRMC,000000,A,2200.1,S,01756.3,W,9.1,215,320814,,",
                           "GPZDA,000000,31,02,2014,,",
                           "GPZDA,000000,01,08,14,,",
                           "GPVTG,1,T",
                           "GPVTG,215,T,,M,9.1,K,,",
                           "GPTHS,77.52,Q",
                           "GPROT,x,A",
                           "GPGST,172814.0,,,,,-1,1,1",
                           "SDDBT,15,f,4.57,F,2.5,F",
                           "SDDPT,-1,0",
                           "VDVBW,x,0,A,0,0,V",
                           "PSAT,HPR,170128.00,377.29,-0.75,,N",
                           "PSXN,20,0,0,x,0",
                           "GPDTM,\xff\xfe,,0,N,0,E,0,W84"}) {
    CAPTURE(body);
    CHECK(is<Malformed>(read_navigation(sentence(body))));
  }
  for (const char* line : {"", "$", "hello", "!AIVDM,1*00", "\r\n"}) {
    CAPTURE(line);
    CHECK((is<Malformed>(read_navigation(line)) || is<BadChecksum>(read_navigation(line))));
  }
}
