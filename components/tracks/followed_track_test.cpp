#include "components/tracks/followed_track.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "components/errors/exit_error.h"
#include "kernels/base/frames/attitude.h"

using namespace ensonify;
using namespace ensonify::tracks;
using Catch::WithinAbs;

namespace {

constexpr double kFastest_mps = 10.0;
const frames::Geodetic kOrigin{48.0, -4.5};

std::int64_t ns(double t_s) { return 1'000'000'000'000 + std::llround(1e9 * t_s); }

/// In world metres: north at 2 m/s, with a bend to the east, every half second for 20 s.
Track bend() {
  Track track;
  track.file = "bend.csv";
  for (int i = 0; i <= 40; ++i) track.spots.push_back({ns(0.5 * i), {0.02 * i * i / 4.0, i}});
  return track;
}

Track with_roll(double until_s) {
  Track track = bend();
  for (int i = 0; 0.1 * i <= until_s; ++i) track.roll_rad.push_back({ns(0.1 * i), 0.1 * std::sin(0.6 * i)});
  return track;
}

FollowedTrack follow(const Track& track, const FollowTrack& wanted = {}) {
  return FollowedTrack(track, wanted, kOrigin, kFastest_mps);
}

std::string fault_of(const Track& track, const FollowTrack& wanted = {},
                     const std::optional<frames::Geodetic>& origin = kOrigin) {
  try {
    FollowedTrack(track, wanted, origin, kFastest_mps);
  } catch (const UserError& error) {
    return error.what();
  }
  return "";
}

frames::Attitude attitude(const frames::MovingPose& moving) { return frames::attitude_of(moving.pose.enu_from_body); }
double heading_rad(const frames::MovingPose& moving) { return frames::wrap_pi(attitude(moving).heading_rad); }

}  // namespace

TEST_CASE("a track is at its places at their times, wherever its part begins") {
  const Track track = bend();
  for (const double from_s : {0.0, 3.25}) {
    const FollowedTrack followed = follow(track, {.from_s = from_s});
    CHECK(followed.end_s() == 20.0 - from_s);
    for (const Spot& spot : track.spots) {
      const double t_s = 1e-9 * static_cast<double>(spot.ns - ns(0.0)) - from_s;
      if (t_s < 0.0) continue;
      REQUIRE((followed.at(t_s).pose.position_enu_m.head<2>() - spot.place_enu_m).norm() < 1e-9);
    }
  }
}

TEST_CASE("velocity and turn rates are the derivatives of place and attitude, with a lever arm too") {
  const FollowedTrack followed = follow(with_roll(20.0), {.position_body_m = {1.0, 2.0, -8.0}});
  const double h = 1e-4;
  for (double t_s = 0.333; t_s < 19.0; t_s += 0.71) {
    const frames::MovingPose before = followed.at(t_s - h), now = followed.at(t_s), after = followed.at(t_s + h);
    REQUIRE(((after.pose.position_enu_m - before.pose.position_enu_m) / (2 * h) - now.velocity_enu_mps).norm() < 1e-5);
    const frames::Quaternion turn = before.pose.enu_from_body.conjugate() * after.pose.enu_from_body;
    const double sign = turn.w() < 0.0 ? -1.0 : 1.0;
    REQUIRE((sign * turn.vec() / h - now.angular_rate_body_radps).norm() < 1e-5);
  }
}

TEST_CASE("without a heading the vehicle looks along its way, and before it moves where it will go") {
  Track track;
  track.file = "still.csv";
  for (int i = 0; i <= 5; ++i) track.spots.push_back({ns(i), {0, 0}});
  for (int i = 1; i <= 10; ++i) track.spots.push_back({ns(5 + i), {-2.0 * i, 0}});
  const FollowedTrack followed = follow(track);
  CHECK_THAT(heading_rad(followed.at(0.0)), WithinAbs(-M_PI / 2, 1e-9));
  CHECK_THAT(heading_rad(followed.at(12.0)), WithinAbs(-M_PI / 2, 1e-9));
  track.spots.resize(6);
  CHECK(fault_of(track) ==
        "still.csv: has no heading, and never goes faster than 0.3 m/s; allowed: a track with headings");
}

TEST_CASE("recorded headings count from true north, and turn through it") {
  Track track;
  for (int i = 0; i <= 4; ++i) {
    track.fixes.push_back({ns(i), {48.0, -4.5 + 0.5 + 1e-5 * i}});  // half a degree east of the origin
    track.heading_rad.push_back({ns(i), (i % 2 == 0 ? 359.0 : 361.0 - 360.0) * M_PI / 180.0});
  }
  const FollowedTrack followed = follow(track);
  const double convergence_rad = 0.5 * M_PI / 180.0 * std::sin(48.0 * M_PI / 180.0);
  CHECK_THAT(heading_rad(followed.at(0.0)), WithinAbs(-M_PI / 180.0 - convergence_rad, 1e-5));
  CHECK(std::abs(heading_rad(followed.at(1.5)) + convergence_rad) < 2.0 * M_PI / 180.0);
}

TEST_CASE("heights are the file's where it has them: depth, or height above chart datum; else heave") {
  Track track = with_roll(20.0);
  for (int i = 0; i <= 20; ++i) track.heave_m.push_back({ns(i), 0.25});
  CHECK(follow(track).height() == FollowedTrack::Height::kWaterLevel);
  CHECK_THAT(follow(track).at(3.0).pose.position_enu_m.z(), WithinAbs(0.25, 1e-12));
  for (int i = 0; i <= 20; ++i) track.depth_m.push_back({ns(i), 1.0 * i});
  CHECK(follow(track).height() == FollowedTrack::Height::kDepth);
  CHECK_THAT(follow(track).at(3.0).pose.position_enu_m.z(), WithinAbs(-3.0, 1e-12));
  CHECK_THAT(follow(track).at(3.0).velocity_enu_mps.z(), WithinAbs(-1.0, 1e-12));
  CHECK(follow(track, {.height = FollowTrack::Height::kWater}).height() == FollowedTrack::Height::kWaterLevel);
}

TEST_CASE("modelled attitude leaves the file's roll out; recorded asks for one") {
  CHECK(follow(with_roll(20.0)).attitude_is_recorded());
  const FollowedTrack modelled = follow(with_roll(20.0), {.attitude = FollowTrack::Attitude::kModelled});
  CHECK_FALSE(modelled.attitude_is_recorded());
  CHECK(attitude(modelled.at(1.3)).roll_rad == 0.0);
  CHECK(fault_of(bend(), {.attitude = FollowTrack::Attitude::kRecorded}) ==
        "bend.csv: holds no roll, pitch or heave; allowed: attitude: modelled");
}

TEST_CASE("at its end the vehicle stops") {
  const FollowedTrack followed = follow(bend(), {.to_s = 12.0});
  CHECK(followed.end_s() == 12.0);
  CHECK(followed.at(12.0).velocity_enu_mps.norm() > 1.0);
  CHECK(followed.at(12.5).velocity_enu_mps.norm() == 0.0);
  CHECK((followed.at(12.5).pose.position_enu_m - followed.at(12.0).pose.position_enu_m).norm() == 0.0);
}

TEST_CASE("gaps of places or attitude are refused with their times, unless another part is followed") {
  Track gap = bend();
  gap.spots.erase(gap.spots.begin() + 10, gap.spots.begin() + 33);
  CHECK(
      fault_of(gap) ==
      "bend.csv: has no place from 4.500 to 16.500 s; allowed: 10 s without (longest_gap_s), or another part (from_s, "
      "to_s)");
  CHECK(fault_of(gap, {.longest_gap_s = 12.0}).empty());
  CHECK(fault_of(gap, {.to_s = 4.5}).empty());
  CHECK(fault_of(gap, {.from_s = 16.5}).empty());
  CHECK(fault_of(with_roll(8.0)) ==
        "bend.csv: has no roll from 8.000 to 20.000 s; allowed: 10 s without (longest_gap_s), or another part (from_s, "
        "to_s)");
}

TEST_CASE("a part beyond the track, a single place, speeds that the vehicle does not reach are refused") {
  CHECK(fault_of(bend(), {.from_s = 30.0}) ==
        "bend.csv: from_s 30 is beyond the 20.000 s that the track has; allowed: less");
  CHECK(fault_of(bend(), {.to_s = 30.0}) ==
        "bend.csv: to_s 30 is beyond the 20.000 s that the track has; allowed: no more");
  Track one = bend();
  one.spots.resize(1);
  CHECK(fault_of(one) == "bend.csv: has a single place; allowed: a track of two at least");
  Track leap = bend();
  leap.spots[7].place_enu_m.x() += 40.0;
  CHECK(fault_of(leap) ==
        "bend.csv: goes 40.1 m from 3.000 to 3.500 s, at 80.2 m/s; allowed: fastest_mps of the vehicle, 10, or another "
        "part (from_s, to_s)");
}

TEST_CASE("a site far from the track is refused with the latitude and longitude to use") {
  Track far;
  far.file = "far.nmea";
  for (int i = 0; i <= 4; ++i) far.fixes.push_back({ns(i), {-22.0018 + 1e-5 * i, -17.9393}});
  const std::string site = "allowed: site: { latitude_deg: -22.0018, longitude_deg: -17.9393 }";
  CHECK_THAT(fault_of(far), Catch::Contains("more than 100 km from the site's origin at 48.0000, -4.5000; " + site));
  CHECK_THAT(fault_of(far, {}, std::nullopt), Catch::Contains("that of its raster") && Catch::Contains(site));
  CHECK(fault_of(far, {}, frames::Geodetic{-22.0, -18.0}).empty());
}
