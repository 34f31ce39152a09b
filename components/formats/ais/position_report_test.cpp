#include "components/formats/ais/position_report.h"

#include <catch2/catch.hpp>

using namespace ensonify::formats::ais;

namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0, kKnot_mps = 1852.0 / 3600.0;

/// Of the payload, the number in these bits.
unsigned long bits(const std::string& sentence, std::size_t from, std::size_t count) {
  const std::size_t payload = sentence.find(',', sentence.find(",1,1,,") + 6) + 1;
  unsigned long value = 0;
  for (std::size_t bit = from; bit < from + count; ++bit) {
    const int letter = sentence[payload + bit / 6] - '0';
    value = 2 * value + ((letter > 40 ? letter - 8 : letter) >> (5 - bit % 6) & 1);
  }
  return value;
}

}  // namespace

TEST_CASE("a position report that a moored vessel sent is written as it sent it") {
  // The example of gpsd's page of AIS, as it is decoded there.
  PositionReport report;
  report.mmsi = 477553000;
  report.status = 5;
  report.turn_rate_radps = 0.0;
  report.speed_mps = 0.0;
  report.longitude_deg = -122.34583333;
  report.latitude_deg = 47.58283333;
  report.course_rad = 51.0 * kDegree;
  report.heading_rad = 181.0 * kDegree;
  report.second = 15;
  report.radio = 149208;
  CHECK(vdm(report) == "!AIVDM,1,1,,A,177KQJ5000G?tO`K>RA1wUbN0TKH,0*5F\r\n");
  CHECK(vdo(report).starts_with("!AIVDO,1,1,,,177KQJ5000G?tO`K>RA1wUbN0TKH,0*"));
}

TEST_CASE("a report has codes for what a vessel does not know") {
  PositionReport report;
  report.mmsi = 970000001;
  const std::string sentence = vdm(report);
  CHECK(bits(sentence, 8, 30) == 970000001);
  CHECK(bits(sentence, 38, 4) == 15);
  CHECK(bits(sentence, 42, 8) == 128);    // turn rate
  CHECK(bits(sentence, 50, 10) == 1023);  // speed
  CHECK(bits(sentence, 116, 12) == 3600);
  CHECK(bits(sentence, 128, 9) == 511);
  CHECK(bits(sentence, 137, 6) == 60);
}

TEST_CASE("turn rates go by their roots, speeds end at 102.2 knots, and a whole turn is no direction") {
  PositionReport report;
  report.turn_rate_radps = -10.0 / 60.0 * kDegree;  // 10 degrees a minute to port: 4.733 sqrt(10) = 15
  report.speed_mps = 200.0 * kKnot_mps;
  report.course_rad = 359.96 * kDegree;
  report.heading_rad = -1.0 * kDegree;
  const std::string sentence = vdo(report);
  CHECK(bits(sentence, 42, 8) == 256 - 15);
  CHECK(bits(sentence, 50, 10) == 1022);
  CHECK(bits(sentence, 116, 12) == 0);
  CHECK(bits(sentence, 128, 9) == 359);
  report.turn_rate_radps = 100.0;
  CHECK(bits(vdo(report), 42, 8) == 126);
}
