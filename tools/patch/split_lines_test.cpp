#include "tools/patch/split_lines.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "tools/patch/record_soundings.h"

using namespace ensonify;
using Catch::WithinAbs;
using patch_tool::split_lines;

namespace {

constexpr double kDegree = M_PI / 180.0;

/// Adds pings of two soundings each, one per second, that turn from one heading to another.
void go(std::vector<boresight::Sounding>& soundings, double& t_s, double lasts_s, double from_deg, double to_deg,
        double speed) {
  for (double t = 0; t < lasts_s; ++t, ++t_s) {
    const double heading = (from_deg + (to_deg - from_deg) * t / lasts_s) * kDegree;
    boresight::Sounding s{.time_s = t_s,
                          .enu_from_body = frames::enu_from_body(frames::Attitude{.heading_rad = heading})};
    s.velocity_enu_mps = speed * frames::Vec3(std::sin(heading), std::cos(heading), 0.0);
    soundings.insert(soundings.end(), 2, s);
  }
}

}  // namespace

TEST_CASE("runs are split where the vehicle turns or stops pinging") {
  std::vector<boresight::Sounding> soundings;
  double t_s = 100;
  go(soundings, t_s, 60, 358, 362, 4);  // north, across the full circle
  go(soundings, t_s, 30, 2, 180, 4);    // the turn
  go(soundings, t_s, 40, 180, 180, 2);
  t_s += 30;  // silence
  go(soundings, t_s, 50, 180, 180, 2);
  go(soundings, t_s, 15, 90, 90, 2);  // too short
  const auto lines = split_lines(soundings);
  REQUIRE(lines.size() == 3);
  CHECK_THAT(frames::wrap_pi(lines[0].heading_rad), WithinAbs(0.0, 1 * kDegree));
  CHECK(lines[0].from_s == 100);
  CHECK_THAT(lines[0].to_s, WithinAbs(159, 2));  // the first 10 degrees of the turn belong to it
  CHECK(lines[0].speed_mps == Approx(4));
  CHECK_THAT(lines[1].heading_rad, WithinAbs(M_PI, 2 * kDegree));  // as do the turn's last
  CHECK(lines[1].to_s == 229);
  CHECK(lines[2].from_s == 260);
  CHECK(lines[2].line.soundings.size() == 100);
}

TEST_CASE("no soundings, no lines") { CHECK(split_lines({}).empty()); }
