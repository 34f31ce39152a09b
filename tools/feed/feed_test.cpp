#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "components/formats/nmea/testing/sentence.h"
#include "kernels/base/random/stream.h"
#include "tools/feed/report.h"

using namespace ensonify;
using namespace ensonify::feed_doctor;

namespace {

constexpr double kPi = 3.14159265358979323846;

/// A made-up ship's feed of two minutes.
struct Ship {
  double antenna_up_m = 10.0;  // above the roll centre
  double roll_sign = 1.0;
  double heave_sign = 1.0;
  double ahead_s = 0.2;  // of the clock at arrival, of all times
  double motion_ahead_s = 0.0;
};

std::string time_of(double t_s) {
  const auto ms = static_cast<long>(std::llround(1e3 * std::fmod(t_s + 86400.0, 86400.0)));
  return fmt::format("{:02d}{:02d}{:06.3f}", ms / 3600000, ms / 60000 % 60, static_cast<double>(ms % 60000) / 1e3);
}

Findings findings_of(const Ship& ship) {
  const random::Stream noise(3, "feed_test");
  const frames::LocalProjection map({48.6, -3.9});
  Examiner examiner;
  for (int i = 0; i < 1200; ++i) {
    const double t_s = 0.1 * i, arrival_s = 43200.0 + t_s;
    const double roll_rad = 0.1 * std::sin(2 * kPi * t_s / 8.0), heave_m = 0.5 * std::sin(2 * kPi * t_s / 6.3 + 1.0);
    const double heading_deg = 30.0 + 3.0 * std::sin(2 * kPi * t_s / 60.0);
    if (i % 5 == 0) {
      const double across_m =
          ship.antenna_up_m * std::sin(roll_rad) + 0.02 * noise.normal(static_cast<std::uint64_t>(i));
      const double course_rad = 30.0 * kPi / 180.0;
      const frames::Vec2 ahead(std::sin(course_rad), std::cos(course_rad)), starboard(ahead.y(), -ahead.x());
      const frames::Geodetic place = map.geodetic_of(4.0 * t_s * ahead + across_m * starboard);
      const double latitude = place.latitude_deg, longitude = -place.longitude_deg;
      examiner.take(nmea::sentence(fmt::format(
                        "GPGGA,{},{:02.0f}{:010.7f},N,{:03.0f}{:010.7f},W,4,12,0.7,{:.3f},M,50,M,,",
                        time_of(arrival_s + ship.ahead_s), std::floor(latitude), 60 * std::fmod(latitude, 1.0),
                        std::floor(longitude), 60 * std::fmod(longitude, 1.0), 12.0 + heave_m)),
                    arrival_s, true);
    }
    examiner.take(nmea::sentence(fmt::format("PASHR,{},{:.2f},T,{:+.3f},{:+.3f},{:+.3f},0.05,0.05,0.1,1,1",
                                             time_of(arrival_s + ship.ahead_s + ship.motion_ahead_s), heading_deg,
                                             ship.roll_sign * roll_rad * 180 / kPi, 0.0, ship.heave_sign * heave_m)),
                  arrival_s, true);
  }
  return examiner.findings();
}

std::string report(const Ship& ship) { return report_of(findings_of(ship), "udp: 10110").text; }

}  // namespace

TEST_CASE("a good feed has right signs, its time scale, and the antenna's height within its error") {
  const Report found = report_of(findings_of({}), "udp: 10110");
  INFO(found.text);
  CHECK(found.faults.empty());
  CHECK_THAT(found.text, Catch::Contains("sign of roll: right") && Catch::Contains("sign of heave: right") &&
                             Catch::Contains("time scale: UTC: +0.20 s"));
  CHECK_THAT(found.text, Catch::Contains("GPGGA            240  2 Hz") && Catch::Contains("talkers: GP"));
  const Sign roll = signs_of(findings_of({})).front();
  REQUIRE(roll.slope);
  CHECK(roll.slope->standard_error < 0.1);
  CHECK(std::abs(roll.slope->value - 10.0) < 4.0 * roll.slope->standard_error + 0.05);  // joined over 0.1 s: some mm
  CHECK_THAT(found.text,
             Catch::EndsWith(
                 "sources:\n  ship: { udp: 10110 }   # unless it is measured: antenna_position_m: [0, 0, -10.0]\n"));
}

TEST_CASE("a wrong roll and a wrong heave are found, and corrected in the source") {
  const std::string text = report({.roll_sign = -1.0, .heave_sign = -1.0});
  CHECK_THAT(text, Catch::Contains("sign of roll: reversed") && Catch::Contains("sign of heave: reversed"));
  CHECK_THAT(text, Catch::Contains("udp: 10110, roll_reversed: true, heave_reversed: true }"));
}

TEST_CASE("fixes that hold no roll say nothing of its sign") {
  CHECK_THAT(report({.antenna_up_m = 0.0}), Catch::Contains("sign of roll: not known: the two do not go together"));
}

TEST_CASE("GPS time is named, and two scales on one way") {
  CHECK_THAT(report({.ahead_s = 18.1}),
             Catch::Contains("time scale: GPS: +18.10 s") && Catch::Contains("time_scale: gps"));
  CHECK_THAT(report({.motion_ahead_s = 18.0}), Catch::Contains("two scales on one way: motion is +18.0 s ahead"));
}

TEST_CASE("as JSON the findings are those of the text, and what is not known is null") {
  const Findings found = findings_of({.heave_sign = -1.0, .ahead_s = 18.1});
  const Report report = report_of(found, "tcp: 4001, of: 127.0.0.1");
  const auto json = nlohmann::json::parse(json_of(found, report, {3, "connection was closed"}));
  REQUIRE(json["faults"].size() == 2);  // the time scale, and heave
  for (const std::string fault : json["faults"]) CHECK_THAT(report.text, Catch::Contains(fault + "\n"));
  CHECK(json["time_scale"] == "gps");
  CHECK_THAT(report.text, Catch::Contains("  ship: " + json["source"].get<std::string>()));
  CHECK(json["format"] == "nmea");
  CHECK(json["talkers"] == nlohmann::json{"GP"});
  CHECK(json["fixes_by_quality"]["4"] == 240);
  REQUIRE(json["kinds"].size() == 2);
  CHECK(json["kinds"][0]["kind"] == "GPGGA");
  CHECK(json["kinds"][0]["count"] == 240);
  CHECK(std::abs(json["kinds"][0]["arrivals"]["rate_hz"].get<double>() - 2.0) < 1e-6);
  CHECK(json["signs"][0]["is"] == "right");
  CHECK(json["signs"][1]["is"] == "reversed");
  CHECK(std::abs(json["antenna_up_m"].get<double>() - 10.0) < 0.5);
  CHECK(json["refused"] == 3);
  CHECK(json["trouble"] == "connection was closed");

  const auto silent = nlohmann::json::parse(json_of({}, report_of({}, "udp: 10110"), {}));
  CHECK(silent["faults"].size() == 1);
  for (const char* key : {"format", "source", "time_scale", "antenna_up_m", "seconds", "trouble"})
    CHECK(silent[key].is_null());
}

TEST_CASE("bytes of a feed that are no UTF-8 do not break the JSON") {
  Examiner examiner;
  examiner.take(nmea::sentence("\xff\xfeHDT,12.5,T"), 1.0, true);
  const Findings found = examiner.findings();
  REQUIRE(found.kinds.size() == 1);
  CHECK(nlohmann::json::accept(json_of(found, report_of(found, "udp: 10110"), {})));
}

TEST_CASE("dates of a week that rolled over are to be corrected; those of an old log are not") {
  constexpr double kDay_s = 86400.0, kNoon_s = 20000.5 * kDay_s;  // of 4 October 2024
  const auto faults_of = [&](const char* date, double off_days) {
    Examiner examiner;
    for (int i = 0; i < 10; ++i)
      examiner.take(nmea::sentence(fmt::format("GPZDA,1200{:02d}.00,{},00,00", i, date)), kNoon_s + i, true);
    const Findings found = examiner.findings();
    CHECK(found.dates_ahead_days.at(std::lround(off_days)) == 10);
    return report_of(found, "udp: 10110").faults;
  };
  CHECK(faults_of("04,10,2024", 0).empty());
  CHECK(faults_of("03,10,2024", -1).empty());
  const auto faults = faults_of("18,02,2005", -7168);
  REQUIRE(faults.size() == 1);
  CHECK(faults[0] ==
        "dates: 10 are 7168 days behind the clock at arrival: the receiver's week has rolled over; nav_feed uses no "
        "dates");
}

TEST_CASE("bad checksums, half lines and repeats are counted") {
  Examiner examiner;
  for (int i = 0; i < 10; ++i) {
    std::string heading = nmea::sentence("HEHDT,12.5,T");
    if (i == 4) heading[7] = '9';
    if (i == 6) heading.erase(9);
    examiner.take(heading, i, true);
  }
  const Findings found = examiner.findings();
  CHECK(found.bad_checksums + found.malformed == 2);
  CHECK(found.kinds.at("HEHDT").count == 8);
  CHECK(found.kinds.at("HEHDT").repeats == 7);
  CHECK_THAT(report_of(found, "udp: 10110").text, Catch::Contains("place: false, motion: false"));
}

TEST_CASE("a TSS1 sensor's heave is held against its own acceleration") {
  for (const double sign : {1.0, -1.0}) {
    Examiner examiner;
    for (int i = 0; i < 1500; ++i) {
      const double t_s = 0.04 * i, swing = std::sin(2 * kPi * t_s / 7.0);
      const auto heave_cm = static_cast<int>(std::lround(80.0 * sign * swing));
      const auto steps = static_cast<std::int16_t>(std::lround(-0.8 * std::pow(2 * kPi / 7.0, 2) * swing / 0.000625));
      examiner.take(fmt::format(":00{:04X} {}{:04d}F 0100  0050\r\n", static_cast<std::uint16_t>(steps),
                                heave_cm < 0 ? '-' : ' ', std::abs(heave_cm)),
                    100.0 + t_s, false);
    }
    const Findings found = examiner.findings();
    CHECK(found.format == Findings::Format::kTss1);
    CHECK_THAT(report_of(found, "serial: /dev/ttyUSB0").text,
               Catch::Contains(sign > 0 ? "sign of heave: right" : "sign of heave: reversed") &&
                   Catch::Contains("serial: /dev/ttyUSB0, format: tss1"));
  }
}

TEST_CASE("a sensor whose acceleration is zero throughout says nothing of its heave's sign") {
  Examiner examiner;
  for (int i = 0; i < 1500; ++i) {
    const auto heave_cm = static_cast<int>(std::lround(80.0 * std::sin(2 * kPi * 0.04 * i / 7.0)));
    examiner.take(fmt::format(":000000 {}{:04d}F 0100  0050\r\n", heave_cm < 0 ? '-' : ' ', std::abs(heave_cm)),
                  100.0 + 0.04 * i, false);
  }
  CHECK_THAT(report_of(examiner.findings(), "serial: /dev/ttyUSB0").text, Catch::Contains("sign of heave: not known"));
}

TEST_CASE("silence and noise are said plainly") {
  CHECK_THAT(report_of(Findings{}, "udp: 10110").text, Catch::StartsWith("nothing has come"));
  Examiner examiner;
  examiner.take("\x01\x02\x03noise", 1.0, true);
  CHECK_THAT(report_of(examiner.findings(), "udp: 10110").text, Catch::Contains("none of a known format"));
}

TEST_CASE("a research vessel's log: her roll and heave are right") {
  const char* shared = std::getenv("ENSONIFY_SHARED");
  const auto path = std::filesystem::path(shared ? shared : "") / "data/nav/nbp1406_seapath330.nmea";
  if (!shared || !std::filesystem::exists(path)) {
    WARN("skipped: no data/nav/nbp1406_seapath330.nmea in the folder that ENSONIFY_SHARED names");
    return;
  }
  Examiner examiner;
  std::ifstream in(path);
  for (std::string line; std::getline(in, line);) {
    const double at_s = 60.0 * std::stod(line.substr(14, 2)) + std::stod(line.substr(17, 9));
    examiner.take(line.substr(line.find('$')) + "\n", at_s, false);
  }
  const std::string text = report_of(examiner.findings(), "udp: 10110").text;
  INFO(text);
  CHECK_THAT(text, Catch::Contains("talkers: IN") && Catch::Contains("time scale: UTC"));
  // Heights of her fixes and her heave add up to a level sea, sample by sample.
  CHECK_THAT(text, Catch::Contains("sign of roll: right") && Catch::Contains("sign of heave: right") &&
                       Catch::Contains("slope 1.00 +- 0.00"));
}
