#include "components/formats/nmea/writer.h"

#include <catch2/catch.hpp>
#include <string>

using namespace ensonify::nmea;
using Catch::WithinAbs;

namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;
constexpr double kHundredth = 0.005 * kDegree;  // half of the last digit of an angle

template <class Found>
Found read(const std::string& sentence) {
  CAPTURE(sentence);
  CHECK(sentence.ends_with("\r\n"));
  const Navigation found = read_navigation(sentence);
  REQUIRE(std::holds_alternative<Found>(found));
  return std::get<Found>(found);
}

}  // namespace

TEST_CASE("sentences that instruments sent are written as they sent them") {
  // A receiver on a research vessel (HDT, PSXN), the manual of a positioning system (PASHR), and gpsd's page (ROT).
  CHECK(hdt("IN", {218.26 * kDegree}) == "$INHDT,218.26,T*1A\r\n");
  CHECK(psxn_23({{}, 218.26 * kDegree, 0.35 * kDegree, -1.74 * kDegree, -0.58}) ==
        "$PSXN,23,0.35,-1.74,218.26,0.58*13\r\n");
  CHECK(pashr({16 * 3600.0 + 30 * 60 + 29, 158.09 * kDegree, -0.30 * kDegree, 0.31 * kDegree, 0.01},
              {0.029 * kDegree, 0.029 * kDegree, 0.059 * kDegree},
              1) == "$PASHR,163029.000,158.09,T,-0.30,+0.31,+0.01,0.029,0.029,0.059,1,1*3B\r\n");
  CHECK(psxn_20({}) == "$PSXN,20,0,0,0,0*3B\r\n");
  CHECK(rot("TI", {-35.6 * kDegree / 60.0}) == framed("TIROT,-35.60,A"));
}

TEST_CASE("what is written is read again, to the last digit that is written") {
  const Fix fix{43'200.2, 4, -22.001848316, -17.939323867, 0.7, -2.7614, 4.6723};
  const auto found = read<Fix>(gga("GP", fix));
  CHECK_THAT(found.time_s, WithinAbs(fix.time_s, 5e-4));
  CHECK(found.quality == 4);
  CHECK_THAT(found.latitude_deg, WithinAbs(fix.latitude_deg, 0.5e-7 / 60.0 * 1.001));
  CHECK_THAT(found.longitude_deg, WithinAbs(fix.longitude_deg, 0.5e-7 / 60.0 * 1.001));
  CHECK(found.hdop == 0.7);
  CHECK_THAT(*found.height_above_geoid_m, WithinAbs(*fix.height_above_geoid_m, 5e-4));
  CHECK_THAT(*found.geoid_above_ellipsoid_m, WithinAbs(*fix.geoid_above_ellipsoid_m, 5e-4));

  const auto gst_found = read<FixAccuracy>(gst("GN", {3661.5, 0.0123, 0.0234, 0.0345}));
  CHECK_THAT(gst_found.time_s, WithinAbs(3661.5, 1e-9));
  CHECK_THAT(gst_found.latitude_m, WithinAbs(0.0123, 5e-4));
  CHECK_THAT(*gst_found.height_m, WithinAbs(0.0345, 5e-4));

  const auto day = std::chrono::sys_days(std::chrono::year(2025) / 6 / 1);
  const auto zda_found = read<DateAndTime>(zda("GP", {43'200.0, day}));
  CHECK(zda_found.time_s == 43'200.0);
  CHECK(zda_found.date == day);

  const auto course = read<Course>(vtg("IN", {215.114 * kDegree, 4.321}));
  CHECK_THAT(*course.true_course_rad, WithinAbs(215.114 * kDegree, kHundredth));
  CHECK_THAT(course.speed_mps, WithinAbs(4.321, 3e-4));
  CHECK_THAT(read<TurnRate>(rot("TI", {-0.0123})).rate_radps, WithinAbs(-0.0123, kHundredth / 60.0));
  const auto depth = read<WaterDepth>(dpt("SD", {12.345, -1.5}));
  CHECK_THAT(depth.below_transducer_m, WithinAbs(12.345, 0.0051));
  CHECK(*depth.offset_m == -1.5);
  CHECK_THAT(read<WaterDepth>(dbt("SD", {12.345, {}})).below_transducer_m, WithinAbs(12.345, 0.0051));

  const Motion motion{86'399.9994, 359.994 * kDegree, -1.234 * kDegree, 2.345 * kDegree, -0.456};
  for (const std::string& sentence : {pashr(motion, {}, 4), psxn_23(motion)}) {
    const auto read_motion = read<Motion>(sentence);
    CHECK_THAT(*read_motion.true_heading_rad, WithinAbs(*motion.true_heading_rad, kHundredth));
    CHECK_THAT(*read_motion.roll_rad, WithinAbs(*motion.roll_rad, kHundredth));
    CHECK_THAT(*read_motion.pitch_rad, WithinAbs(*motion.pitch_rad, kHundredth));
    CHECK_THAT(*read_motion.heave_m, WithinAbs(*motion.heave_m, 0.0051));
  }
  CHECK_THAT(*read<Motion>(pashr(motion, {}, 4)).time_s, WithinAbs(86'399.999, 1e-9));

  const auto quality = read<MotionQuality>(psxn_20({.heave = true, .roll_and_pitch = false, .heading = true}));
  CHECK(quality.heave);
  CHECK_FALSE(quality.roll_and_pitch);
  CHECK(quality.heading);
}

TEST_CASE("what is not given is blank, and a fix without quality has no place") {
  const auto motion = read<Motion>(pashr({1.0, {}, {}, 0.1, {}}, {}, 0));
  CHECK_FALSE(motion.true_heading_rad);
  CHECK_FALSE(motion.roll_rad);
  CHECK(motion.pitch_rad);
  CHECK_FALSE(motion.heave_m);
  CHECK_FALSE(read<Course>(vtg("GP", {{}, 0.0})).true_course_rad);
  CHECK_FALSE(read<WaterDepth>(dpt("SD", {5.0, {}})).offset_m);
  CHECK_FALSE(read<Fix>(gga("GP", {1.0, 1, 1.0, 1.0, 0.0, {}, {}})).height_above_geoid_m);
  CHECK(read<Fix>(gga("GP", {})).quality == 0);
}

TEST_CASE("no digit overflows: neither 60 minutes, 60 seconds, 360 degrees nor a minus zero") {
  CHECK(gga("GP", {59.9996, 1, 12.99999999999, -7.99999999999, 1.0, {}, {}})
            .starts_with("$GPGGA,000100.000,1300.0000000,N,00800.0000000,W,"));
  CHECK(gga("GP", {59.994, 1, 1.0, 1.0, 1.0, {}, {}}, 2).starts_with("$GPGGA,000059.99,"));
  CHECK(hdt("HE", {359.996 * kDegree}).starts_with("$HEHDT,0.00,T"));
  CHECK(hdt("HE", {-0.5 * kDegree}).starts_with("$HEHDT,359.50,T"));
  CHECK(zda("GP", {86'399.9996, std::chrono::sys_days(std::chrono::year(2024) / 12 / 31)})
            .starts_with("$GPZDA,000000.000,01,01,2025,"));
  CHECK(psxn_23({{}, 0.0, -0.001 * kDegree, 0.0, -0.001}).starts_with("$PSXN,23,0.00,0.00,0.00,0.00*"));
}
