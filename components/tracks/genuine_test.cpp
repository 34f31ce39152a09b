// Genuine files of every format. Where the folder of data is absent, the cases say so and pass.
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>

#include "components/tracks/followed_track.h"

using namespace ensonify;
using namespace ensonify::tracks;

namespace {

std::optional<std::string> genuine(const char* name) {
  const char* shared = std::getenv("ENSONIFY_SHARED");
  const auto path = std::filesystem::path(shared ? shared : "") / "data" / name;
  if (shared && std::filesystem::exists(path)) return path.string();
  WARN("skipped: no data/" << name << " in the folder that ENSONIFY_SHARED names");
  return std::nullopt;
}

double length_s(const Track& track) { return 1e-9 * static_cast<double>(track.fixes.back().ns - track.fixes[0].ns); }

/// The largest distance of the followed track from the file's own places, at their times.
double farthest_m(const Track& track, const FollowTrack& wanted) {
  const frames::Geodetic origin = track.fixes.front().place;
  const frames::LocalProjection world(origin);
  const FollowedTrack followed(track, wanted, origin, 20.0);
  double most_m = 0.0;
  for (const Fix& fix : track.fixes) {
    const double t_s = 1e-9 * static_cast<double>(fix.ns - track.fixes[0].ns) - wanted.from_s;
    if (t_s < 0.0 || t_s > followed.end_s()) continue;
    most_m = std::max(most_m, (followed.at(t_s).pose.position_enu_m.head<2>() - world.enu_of(fix.place)).norm());
  }
  return most_m;
}

}  // namespace

TEST_CASE("a research vessel's log of NMEA lines") {
  const auto file = genuine("nav/nbp1406_seapath330.nmea");
  if (!file) return;
  const Track track = read_track(*file);
  CHECK(track.fixes.size() == 625);
  CHECK(track.roll_rad.size() == 625);
  CHECK(track.heave_m.size() == 625);
  CHECK(track.heading_rad.size() == 625);
  CHECK(farthest_m(track, {}) < 1e-3);
}

TEST_CASE("an hour of RTK at a quay, as a table with semicolons") {
  const auto file = genuine("nav/rimouski_asv_gnss.csv");
  if (!file) return;
  const Track track = read_track(*file);
  CHECK(track.fixes.size() > 3000);
  CHECK(track.heading_rad.empty());
}

TEST_CASE("a GNSS compass on a vessel") {
  const auto file = genuine("records/hemisphere.nmea");
  if (!file) return;
  const Track track = read_track(*file);
  CHECK(track.fixes.size() > 10);
}

TEST_CASE("navigation and attitude of a .all file") {
  const auto file = genuine("records/em710_g_7041.all");
  if (!file) return;
  const Track track = read_track(*file);
  CHECK(track.fixes.size() == 5);
  CHECK(track.roll_rad.size() > 100);
  CHECK(farthest_m(track, {}) < 1e-3);
}

TEST_CASE("navigation and attitude of a .kmall file") {
  const auto file = genuine("records/em2040p_eg.kmall");
  if (!file) return;
  const Track track = read_track(*file);
  CHECK(track.fixes.size() >= 2);
  CHECK(track.roll_rad.size() > 50);
  CHECK(farthest_m(track, {}) < 1e-3);
}

TEST_CASE("an AUV's sidescan in XTF, whose first ping has no place") {
  const auto file = genuine("sonar/scotsman-iver2.xtf");
  if (!file) return;
  const Track track = read_track(*file);
  CHECK(track.fixes.size() > 300);
  CHECK(track.depth_m.size() > 300);
  CHECK(length_s(track) > 20.0);
}
