#include <catch2/catch.hpp>

#include "components/nav_feed/testing/feed.h"
#include "components/nav_feed/wording.h"

using namespace ensonify;
using Catch::WithinAbs;
using nmea::sentence;
using namespace feed;

namespace {

constexpr double kNoon_s = 43200.0;

/// A feed to the north at 2 m/s with bow to north, rolling and heaving a little; the run's second 0 is the feed's noon.
struct Sailing : Fed {
  explicit Sailing(double utc_s = kNoon_s) : utc_of_run_s(utc_s) {}

  double utc_of_run_s;
  std::string motions(double utc_s) const {
    return heading(0.0) + motion_sentence(utc_s, std::sin(utc_s), 0.5 * std::cos(utc_s));
  }
  /// Second `i` of the run, at which the feed has another time or place, if wanted.
  void second(int i, double off_s = 0.0, double off_east_m = 0.0) {
    const double utc_s = std::fmod(utc_of_run_s + i + off_s + 86400.0, 86400.0);
    feed.take(fix(utc_s, off_east_m, 2.0 * i) + motions(utc_s), at_s(i));
  }
  void seconds_from(int first, int last, double off_s = 0.0, double off_east_m = 0.0) {
    for (int i = first; i <= last; ++i) second(i, off_s, off_east_m);
  }
  frames::Vec3 position(double t_s) const { return feed.at(at_s(t_s))->pose.position_enu_m; }
  bool follows(double t_s) const {
    const auto moving = feed.at(at_s(t_s));
    return moving && (moving->pose.position_enu_m.head<2>() - frames::Vec2(0.0, 2.0 * (t_s - 2.5))).norm() < 0.01 &&
           std::abs(moving->pose.position_enu_m.z()) <= 0.6;
  }
};

}  // namespace

TEST_CASE("one fix three hours ahead changes nothing, and health says what it was") {
  Sailing sailing;
  sailing.seconds_from(0, 10);
  CHECK(sailing.feed.trouble(at_s(10)) == "");
  sailing.second(11, 3 * 3600.0);
  CHECK(sailing.feed.trouble(at_s(11)) ==
        "time jumped ahead by 3 h 0 min: not followed unless three fixes in a row agree");
  sailing.seconds_from(12, 40);
  CHECK(sailing.feed.trouble(at_s(40)) == "");
  CHECK(sailing.counts["fixes_at_another_time"] == 1);
  CHECK(sailing.counts["sentences_late"] == 0);
  CHECK(sailing.counts["fixes_taken"] == 40);
  for (double t = 15.0; t < 40.0; t += 0.1) REQUIRE(sailing.follows(t));
}

TEST_CASE("a log that starts again is followed again within three fixes") {
  for (const double back_s : {-3 * 3600.0, -600.0, -18.0, 18.0, 11 * 3600.0}) {
    CAPTURE(back_s);
    Sailing sailing;
    sailing.seconds_from(0, 20);
    sailing.seconds_from(21, 22, back_s);
    const std::string jump =
        std::string("time jumped ") + (back_s < 0 ? "back" : "ahead") + " by " + duration_text(back_s);
    CHECK(sailing.feed.trouble(at_s(22)) == jump + ": not followed unless three fixes in a row agree");
    sailing.second(23, back_s);
    CHECK(sailing.feed.trouble(at_s(23)) == jump + ": the vehicle has not come there yet");
    sailing.seconds_from(24, 60, back_s);
    CHECK(sailing.feed.trouble(at_s(24)) == "");
    CHECK(sailing.counts["time_jumps"] == 1);
    CHECK(sailing.counts["fixes_taken"] == 61);
    for (double t = 24.0; t < 60.0; t += 0.1) REQUIRE(sailing.follows(t));
  }
}

TEST_CASE("GPS time of one of two sources never takes the fixes along") {
  Sailing sailing;  // its motion sensor counts 18 s more than UTC
  for (int i = 0; i <= 30; ++i) {
    sailing.feed.take(fix(kNoon_s + i, 0.0, 2.0 * i) + heading(0.0), at_s(i));
    for (int j = 0; j < 10; ++j) {
      sailing.feed.take(motion_sentence(kNoon_s + i + 0.1 * j + 18.0, 5.0, 1.0), at_s(i + 0.1 * j));
    }
  }
  CHECK(sailing.counts["fixes_taken"] == 31);
  CHECK(sailing.counts["motions_at_another_time"] == 310);
  CHECK(sailing.feed.trouble(at_s(30)) == "motion is 18.0 s ahead of the fixes: not taken");
  CHECK(sailing.follows(30));
}

TEST_CASE("dates that are 1,024 weeks old change nothing, and health says it") {
  Sailing sailing;
  for (int i = 0; i <= 30; ++i) {
    const std::string time = time_of(kNoon_s + i);
    sailing.feed.take(
        sentence("GPZDA," + time + (i == 10 ? ",16,12,2006,," : ",01,08,2026,,")) +
            sentence("GPRMC," + time + ",A,5312.60,N,00922.20,W,3.9,0.0," + (i == 10 ? "161206" : "010826") + ",,,A"),
        at_s(i));
    sailing.second(i);
  }
  CHECK(sailing.counts["fixes_taken"] == 31);
  CHECK(sailing.counts["dates_jumped"] == 2);
  CHECK(sailing.feed.trouble(at_s(30)) == "");
  for (double t = 3.0; t < 30.0; t += 0.1) REQUIRE(sailing.follows(t));
}

TEST_CASE("a day without dates, midnight and a leap second lose and double no sample") {
  Sailing sailing;
  int samples = 0;
  for (int i = -30; i <= 30; ++i) {  // second 0 is 23:59:60
    const double at = 30 + i;
    const std::string time = i == 0 ? "235960.000" : time_of(i < 0 ? 86400.0 + i : i - 1.0);
    const auto place = fix(0.0, 0.0, 2.0 * at);
    sailing.feed.take(sentence("GPGGA," + time + place.substr(17, place.find('*') - 17)) + heading(0.0), at_s(at));
    for (int j = 0; j < 10; ++j) {
      const std::string tenth = time.substr(0, 7) + std::to_string(j) + "00";
      sailing.feed.take(sentence("PASHR," + tenth + ",0.00,T,+1.00,+0.00,+0.10,0.1,0.1,0.1,1,1"), at_s(at + 0.1 * j));
      ++samples;
    }
  }
  CHECK(sailing.counts["fixes_taken"] == 61);
  CHECK(sailing.counts["motions_taken"] == samples);
  CHECK(sailing.counts["sentences_late"] == 0);
  CHECK(sailing.feed.trouble(at_s(60)) == "");
  for (double t = 3.0; t < 60.0; t += 0.1) REQUIRE(sailing.follows(t));
}

TEST_CASE("before anything has come, health names that alone") {
  Sailing sailing;
  CHECK(sailing.feed.trouble(at_s(0)) == "no place yet: no fix has come");
  CHECK(sailing.feed.trouble(at_s(10)) == "no place yet: no fix has come");
}

TEST_CASE("a first fix 50 km off is not accepted") {
  Sailing sailing;
  sailing.second(0, 0.0, 50e3);
  CHECK(sailing.feed.trouble(at_s(0)) == "no place yet: a first fix counts when three in a row agree");
  sailing.seconds_from(1, 20);
  CHECK(sailing.counts["fixes_that_none_agreed_with"] == 1);
  CHECK(sailing.counts["fixes_taken"] == 20);
  CHECK_FALSE(sailing.feed.at(at_s(3)));
  for (double t = 3.6; t < 20.0; t += 0.1) REQUIRE(sailing.follows(t));
}

TEST_CASE("one wild fix is left out; a jump that three fixes agree about is followed") {
  Sailing sailing;
  sailing.seconds_from(0, 10);
  sailing.second(11, 0.0, 50e3);
  CHECK(sailing.feed.trouble(at_s(11)) == "place jumped by 50.0 km: not followed unless three fixes in a row agree");
  sailing.seconds_from(12, 20);
  CHECK(sailing.feed.trouble(at_s(20)) == "");
  for (double t = 12.6; t < 20.0; t += 0.1) REQUIRE(sailing.follows(t));
  sailing.seconds_from(21, 30, 0.0, 500.0);
  CHECK(sailing.counts["place_jumps"] == 1);
  CHECK(sailing.counts["fixes_taken"] == 30);
  // Straight on until the first of the fixes beyond the jump, then there: never in between.
  CHECK_THAT(sailing.position(23.49).x(), WithinAbs(0.0, 0.01));
  CHECK_THAT(sailing.position(23.51).x(), WithinAbs(500.0, 0.01));
}

TEST_CASE("two sources that contradict each other: the one that came first is followed") {
  Sailing sailing;
  sailing.seconds_from(0, 5);
  for (int i = 6; i <= 30; ++i) {
    sailing.second(i);
    sailing.feed.take(fix(kNoon_s + i + 0.5, 2e3, 0.0), at_s(i + 0.5));
  }
  CHECK(sailing.counts["fixes_beyond_the_fastest_speed"] == 25);
  CHECK(sailing.counts["place_jumps"] == 0);
  CHECK(sailing.follows(30));
}

TEST_CASE("ten fixes a second are accepted after a second, not after three of them") {
  Fed fed;
  for (int i = 0; i <= 9; ++i) fed.feed.take(fix(100.0 + 0.1 * i, 0.0, 0.0) + heading(0.0), at_s(0.1 * i));
  CHECK(fed.counts["fixes_taken"] == 0);
  fed.feed.take(fix(101.0, 0.0, 0.0), at_s(1.0));
  CHECK(fed.counts["fixes_taken"] == 11);
}

TEST_CASE("across a gap heave, roll and heading are held; the way goes on for its time and stops") {
  Sailing sailing;
  sailing.seconds_from(0, 20);
  const frames::Vec3 last = sailing.position(22.5);
  for (double t = 22.6; t < 80.0; t += 0.1) REQUIRE(std::abs(sailing.position(t).z() - last.z()) < 1e-9);
  CHECK_THAT(sailing.position(32.5).y(), WithinAbs(60.0, 0.01));  // for 10 s at 2 m/s
  CHECK_THAT(sailing.position(80.0).y(), WithinAbs(60.0, 0.01));
  CHECK(sailing.feed.at(at_s(80))->velocity_enu_mps.norm() == 0.0);
  CHECK(sailing.feed.trouble(at_s(24.5)) == "no fix for 2.0 s: the vehicle goes straight on");
  CHECK(sailing.feed.trouble(at_s(82.5)) ==
        "no fix for 1 min 0 s: the vehicle stays where it is; no heading for 1 min 0 s: held; no roll for 1 min 0 s: "
        "held; no pitch for 1 min 0 s: held; no heave for 1 min 0 s: held");
  sailing.seconds_from(90, 110);
  for (double t = 82.5; t < 110.0; t += 0.05) REQUIRE(std::abs(sailing.position(t).z()) <= 0.51);
  CHECK(sailing.feed.trouble(at_s(110)) == "");
  for (double t = 92.6; t < 110.0; t += 0.1) REQUIRE(sailing.follows(t));
}

TEST_CASE("without the gyro for a while the motion sentences' heading is taken") {
  Fed fed;
  for (int i = 0; i <= 20; ++i) {
    fed.feed.take(fix(100 + i, 0.0, 2.0 * i) + (i <= 5 ? heading(45.0) : ""), at_s(i));
    fed.feed.take(sentence("PASHR," + time_of(100 + i) + ",90.00,T,+2.00,-1.00,+0.25,0.1,0.1,0.1,1,1"), at_s(i));
  }
  const auto heading_deg = [&](double t) {
    return frames::attitude_of(fed.feed.at(at_s(t))->pose.enu_from_body).heading_rad / kDegree;
  };
  CHECK_THAT(heading_deg(7.0), WithinAbs(45.0, 0.01));
  CHECK_THAT(heading_deg(20.0), WithinAbs(90.0, 0.01));
}
