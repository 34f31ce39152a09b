#include "components/nav_feed/fed_track.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "components/nav_feed/testing/feed.h"

using namespace ensonify;
using Catch::WithinAbs;
using nmea::sentence;
using namespace feed;

TEST_CASE("a vehicle follows its fixes delayed, across midnight, with their derivatives") {
  Fed fed;
  const auto east = [](double t) { return 3.0 * t; };
  const auto north = [](double t) { return 100.0 + 20.0 * std::sin(0.1 * t); };
  const double before_midnight_s = 86390.0;
  for (int i = 0; i <= 30; ++i) {
    fed.feed.take(fix(before_midnight_s + i, east(i), north(i)) + heading(359.0 + 0.5 * i - (i > 1 ? 360 : 0)),
                  at_s(5 + i));
  }
  CHECK(fed.counts["fixes_taken"] == 31);
  CHECK(fed.counts["headings_taken"] == 31);
  CHECK_FALSE(fed.feed.at(at_s(7.4)));  // the first fix came at 5 s and is run 2.5 s later
  for (double t = 9.0; t < 33.0; t += 0.37) {
    const auto moving = fed.feed.at(at_s(t));
    REQUIRE(moving);
    // Of a curve through samples h = 1 s apart, by (w h)^3 / 12 of the amplitude at most: 20 * 0.001 / 12.
    REQUIRE_THAT(moving->pose.position_enu_m.x(), WithinAbs(east(t - 7.5), 0.002));
    REQUIRE_THAT(moving->pose.position_enu_m.y(), WithinAbs(north(t - 7.5), 0.004));
    const auto later = fed.feed.at(at_s(t + 1e-3));
    const frames::Vec3 rate = (later->pose.position_enu_m - moving->pose.position_enu_m) / 1e-3;
    REQUIRE((rate - moving->velocity_enu_mps).norm() < 1e-3);
    const double grid_rad = frames::attitude_of(moving->pose.enu_from_body).heading_rad;
    const double convergence = frames::LocalProjection(kOrigin).convergence_rad({east(t - 7.5), north(t - 7.5)});
    REQUIRE_THAT(frames::wrap_pi(grid_rad + convergence - (359.0 + 0.5 * (t - 7.5)) * kDegree), WithinAbs(0.0, 1e-4));
  }
}

TEST_CASE("roll, pitch and heave come from motion sentences; the gyro's heading goes first") {
  Fed fed;
  for (int i = 0; i <= 6; ++i) {
    fed.feed.take(fix(100 + i, 0.0, i), at_s(i));
    fed.feed.take(sentence("PASHR," + time_of(100 + i) + ",90.00,T,+2.00,-1.00,+0.25,0.1,0.1,0.1,1,1"), at_s(i));
  }
  const auto moving = *fed.feed.at(at_s(6.0));
  const auto attitude = frames::attitude_of(moving.pose.enu_from_body);
  CHECK(attitude.roll_rad == Approx(2.0 * kDegree));
  CHECK(attitude.pitch_rad == Approx(-1.0 * kDegree));
  CHECK_THAT(attitude.heading_rad, WithinAbs(90.0 * kDegree, 1e-6));
  CHECK(moving.pose.position_enu_m.z() == Approx(0.25));
  fed.feed.take(heading(45.0), at_s(7));
  fed.feed.take(sentence("PASHR," + time_of(107) + ",90.00,T,+2.00,-1.00,+0.25,0.1,0.1,0.1,1,1"), at_s(7.1));
  CHECK(fed.counts["motions_taken"] == 8);
  CHECK_THAT(frames::attitude_of(fed.feed.at(at_s(12))->pose.enu_from_body).heading_rad,
             WithinAbs(45.0 * kDegree, 1e-6));
}

TEST_CASE("what cannot be used is counted, and the vehicle goes on as before") {
  Fed fed;
  fed.feed.take(heading(10.0), at_s(0));  // nothing gives what time that is
  for (int i = 0; i <= 6; ++i) fed.feed.take(fix(100 + i, i, 0.0) + heading(90.0), at_s(i));
  const auto before = fed.feed.at(at_s(6))->pose.position_enu_m;
  fed.feed.take("rubbish\r\n$HEHDT,12.0,T*00\r\n\r\n" + sentence("GPXDR,C,12.0,C,AIR") +
                    sentence("GPVTG,1,T,,M,4.0,N,7.4,K") + sentence("GPHDT,,T") +
                    sentence("GPGGA,000150.00,,,,,0,,,,M,,M,,") + sentence("HEHDT,999,T") + fix(105, 0.0, 0.0) +
                    fix(107, 500.0, 0.0) + fix(107, 200e3, 0.0),
                at_s(6));
  CHECK(fed.feed.at(at_s(6))->pose.position_enu_m == before);
  const std::map<std::string, int> expected{{"sentences_before_the_first_fix", 1},
                                            {"fixes_taken", 7},
                                            {"headings_taken", 7},
                                            {"sentences_malformed", 2},
                                            {"sentences_with_bad_checksum", 1},
                                            {"sentences_of_other_kinds", 1},
                                            {"sentences_read_only", 1},
                                            {"sentences_without_data", 1},
                                            {"fixes_invalid", 1},
                                            {"sentences_late", 1},
                                            {"fixes_beyond_the_fastest_speed", 1},
                                            {"fixes_far_from_the_site", 1}};
  CHECK(fed.counts == expected);
}

TEST_CASE("without fixes it goes straight on and reports it; new fixes are followed again") {
  Fed fed;
  for (int i = 0; i <= 10; ++i) fed.feed.take(fix(100 + i, 2.0 * i, 0.0) + heading(90.0), at_s(i));
  CHECK_FALSE(fed.feed.lacks_data(at_s(12.5)));
  CHECK(fed.feed.lacks_data(at_s(12.6)));
  CHECK_THAT(fed.feed.at(at_s(22.5))->pose.position_enu_m.x(), WithinAbs(40.0, 0.01));  // 10 s at 2 m/s
  for (int i = 25; i <= 40; ++i) fed.feed.take(fix(100 + i, 60.0, 5.0), at_s(i));
  CHECK_THAT(fed.feed.at(at_s(40))->pose.position_enu_m.x(), WithinAbs(60.0, 0.01));
  fed.feed.forget(at_s(40));
  CHECK_THAT(fed.feed.at(at_s(40))->pose.position_enu_m.y(), WithinAbs(5.0, 0.01));
}

TEST_CASE("fixes of an antenna off the reference point lead the reference point") {
  // In a circle of 50 m about the origin, 4 degrees a second to starboard, the antenna 6 m ahead and 2 m to starboard.
  NavFeedConfig config;
  config.sources[0].antenna_body_m = {6.0, 2.0, -5.0};
  Fed fed{.config = config};
  const double rate = 4.0 * kDegree;
  const auto forward = [&](double t) { return frames::Vec2(std::cos(rate * t), -std::sin(rate * t)); };
  const auto starboard = [&](double t) { return frames::Vec2(-std::sin(rate * t), -std::cos(rate * t)); };
  const auto place = [&](double t) -> frames::Vec2 { return -50.0 * starboard(t); };
  for (int i = 0; i <= 30; ++i) {
    const frames::Vec2 antenna = place(i) + 6.0 * forward(i) + 2.0 * starboard(i);
    const double convergence_deg = frames::LocalProjection(kOrigin).convergence_rad(antenna) / kDegree;
    fed.feed.take(fix(100 + i, antenna.x(), antenna.y()) + heading(90.0 + 4.0 * i + convergence_deg), at_s(i));
  }
  for (double t = 5.0; t < 27.0; t += 0.37) {
    const auto moving = *fed.feed.at(at_s(t + 2.5));
    // The curve through samples 0.07 rad apart keeps to (w h)^3 / 12 of its radius: 0.03 mm of 1.5 m.
    REQUIRE((moving.pose.position_enu_m.head<2>() - place(t)).norm() < 0.002);
    REQUIRE(moving.pose.position_enu_m.z() == 0.0);
    REQUIRE((moving.velocity_enu_mps.head<2>() - 50.0 * rate * forward(t)).norm() < 0.01);
    REQUIRE((moving.acceleration_enu_mps2.head<2>() - 50.0 * rate * rate * starboard(t)).norm() < 0.03);
  }
}

TEST_CASE("heights of the antenna give the reference point's, between fixes by heave") {
  // Chart datum lies 1.5 m below the geoid; the tide rises by 1 cm/s while the boat heaves with 4 s and lies over by 10
  // degrees; the antenna is 5 m up and 3 m to starboard.
  NavFeedConfig config;
  config.delay_s = 3.5;
  config.sources[0].antenna_body_m = {0.0, 3.0, -5.0};
  config.height = NavFeedConfig::Height::kGga;
  config.datums.datum_above_geoid = vertical::Separation(-1.5);
  Fed fed{.config = config};
  const auto heave = [](double t) { return 0.5 * std::sin(1.5708 * t); };
  const auto above_datum = [&](double t) { return 2.0 + 0.01 * t + heave(t); };
  const double up_m = 5.0 * std::cos(10.0 * kDegree) - 3.0 * std::sin(10.0 * kDegree);
  CHECK_FALSE(fed.feed.at(at_s(0)));
  for (int i = 0; i <= 300; ++i) {
    const double t = 0.1 * i;
    if (i % 10 == 0) fed.feed.take(fix(t, 0.0, 0.0, above_datum(t) + up_m - 1.5), at_s(t));
    fed.feed.take(motion_sentence(t, 10.0, heave(t)), at_s(t));
  }
  for (double t = 2.0; t < 26.0; t += 0.37) {
    const auto moving = *fed.feed.at(at_s(t + 3.5));
    // Of the heave's curve (w h)^3 / 12 of the amplitude, 0.2 mm, and decimals.
    REQUIRE_THAT(moving.pose.position_enu_m.z(), WithinAbs(above_datum(t), 0.001));
    REQUIRE_THAT(moving.velocity_enu_mps.z(), WithinAbs(0.01 + 0.5 * 1.5708 * std::cos(1.5708 * t), 0.02));
  }
  CHECK_THAT(fed.feed.take_fix()->position_enu_m[2], WithinAbs(above_datum(30.0) + up_m, 1e-3));
  fed.feed.take(sentence("GPGGA,000031.00,5312.6000000,N,00922.2000000,W,4,12,0.7,,M,,M,,"), at_s(31));
  CHECK(fed.counts["fixes_without_height"] == 1);
}

TEST_CASE("RMC gives places where no GGA comes, and none beside it") {
  const auto rmc = [](int second, char status) {
    return sentence("GPRMC," + time_of(100 + second) + "," + status + ",5312.60,N,00922.20,W,4.0,90.0,010826,,,A");
  };
  Fed alone, beside;
  for (int i = 0; i <= 10; ++i) {
    alone.feed.take(rmc(i, i == 5 ? 'V' : 'A') + heading(90.0), at_s(i));
    beside.feed.take(fix(100 + i, 2.0 * i, 0.0) + rmc(i, 'A') + heading(90.0), at_s(i));
  }
  CHECK(alone.counts["fixes_taken"] == 10);
  CHECK(alone.counts["fixes_invalid"] == 1);
  CHECK(alone.feed.at(at_s(10)));
  CHECK(beside.counts["fixes_taken"] == 11);
  CHECK(beside.counts["sentences_read_only"] == 11);
  for (int i = 11; i <= 30; ++i) beside.feed.take(rmc(i, 'A') + heading(90.0), at_s(i));  // GGA has stopped
  CHECK(beside.counts["fixes_taken"] == 27);
}

TEST_CASE("fixes that cannot be used at all are named until one can be") {
  Fed fed;
  for (int i = 0; i <= 5; ++i) fed.feed.take(fix(100 + i, 0.0, 0.0) + heading(90.0), at_s(i));
  fed.feed.take(sentence("GPDTM,999,,0.08,N,0.07,E,-47.7,W84") + fix(106, 0.0, 0.0), at_s(6));
  CHECK(fed.counts["fixes_on_another_datum"] == 1);
  CHECK(fed.feed.trouble(at_s(6)) == "fixes are on datum 999, not W84: not taken");
  fed.feed.take(sentence("GPDTM,W84,,0.0,N,0.0,E,0.0,W84") + fix(107, 0.0, 0.0), at_s(7));
  CHECK(fed.feed.trouble(at_s(7)) == "");
  fed.feed.take(sentence("GPGGA,000148.000,0922.2000,S,05312.6000,E,4,12,0.7,1.0,M,50,M,,"), at_s(8));
  CHECK(fed.counts["fixes_with_latitude_and_longitude_swapped"] == 1);
  CHECK(fed.feed.trouble(at_s(8)) == "latitude and longitude are swapped: not taken");
  fed.feed.take(sentence("GPGGA,000148.500,0922.2000,N,05312.6000,W,4,12,0.7,1.0,M,50,M,,"), at_s(8.5));
  CHECK(fed.counts["fixes_with_latitude_and_longitude_swapped"] == 2);  // the letters stayed where they were
  CHECK(fed.feed.trouble(at_s(8.5)) == "latitude and longitude are swapped: not taken");
  fed.feed.take(sentence("GPGGA,000149.000,4922.2000,N,05312.6000,E,4,12,0.7,1.0,M,50,M,,"), at_s(9));
  CHECK(fed.feed.trouble(at_s(9)).find("km from the site: not taken") != std::string::npos);
  fed.feed.take(fix(110, 0.0, 0.0) + fix(110, 0.0, 0.0), at_s(10));
  CHECK(fed.counts["fixes_double"] == 1);
  CHECK(fed.feed.trouble(at_s(10)) == "");
}

TEST_CASE("fixes of which none can be used are not called absent") {
  Fed fed;
  fed.feed.take(sentence("GPDTM,999,,0.08,N,0.07,E,-47.7,W84") + fix(106, 0.0, 0.0), at_s(0));
  CHECK(fed.feed.trouble(at_s(0)) == "fixes are on datum 999, not W84: not taken; no place yet");
}

TEST_CASE("what a motion sensor leaves blank or calls invalid is held, never zero") {
  Fed fed;
  const auto hpr = [](int second, const std::string& pitch, const std::string& roll) {
    return sentence("PSAT,HPR," + time_of(100 + second) + ",90.00," + pitch + "," + roll + ",N");
  };
  for (int i = 0; i <= 10; ++i) fed.feed.take(fix(100 + i, 0.0, 0.0) + hpr(i, "1.50", i < 5 ? "3.00" : ""), at_s(i));
  const auto attitude = [&] { return frames::attitude_of(fed.feed.at(at_s(12))->pose.enu_from_body); };
  CHECK(attitude().pitch_rad == Approx(1.5 * kDegree));
  CHECK(attitude().roll_rad == Approx(3.0 * kDegree));  // two baselines gave it once
  CHECK(fed.feed.trouble(at_s(12)) == "no roll for 5.5 s: held");
  Fed seapath;
  for (int i = 0; i <= 10; ++i) {
    seapath.feed.take(fix(100 + i, 0.0, 0.0) + sentence(i < 5 ? "PSXN,20,0,0,0,0" : "PSXN,20,0,0,0,2") +
                          sentence(i < 5 ? "PSXN,23,3.00,1.00,90.00,0.10" : "PSXN,23,99.00,45.00,90.00,0.10"),
                      at_s(i));
  }
  CHECK(frames::attitude_of(seapath.feed.at(at_s(12))->pose.enu_from_body).roll_rad == Approx(3.0 * kDegree));
}

TEST_CASE("a fix has the accuracy that GST gives of its time") {
  Fed fed;
  for (int i = 0; i <= 3; ++i) {
    fed.feed.take(sentence("GPGST," + time_of(100 + i) + ",0.9,,,,0.03,0.04,0.06") + fix(100 + i, 0.0, 0.0), at_s(i));
  }
  const auto position = *fed.feed.take_fix();
  CHECK(position.sigma_horizontal_m == Approx(0.05 / std::sqrt(2.0)));
  CHECK(position.sigma_vertical_m == 0.06);
  CHECK(position.geoid_above_ellipsoid_m == 50.0);
}
