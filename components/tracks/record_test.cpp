#include <catch2/catch.hpp>
#include <cmath>

#include "components/record/testing/test_folder.h"
#include "components/record/writer.h"
#include "components/tracks/followed_track.h"
#include "kernels/base/frames/attitude.h"
#include "messages/codec.h"
#include "messages/motion.h"
#include "messages/navigation.h"

using namespace ensonify;
using namespace ensonify::tracks;
using Catch::WithinAbs;

namespace {

/// A record of ten seconds of poses and estimates, which lie 3 m beside them; nothing of a topic without messages.
void write_record(const std::filesystem::path& file, const std::string& scenario, bool two_boats) {
  record::RecordWriter writer(file, {"1.0.0", 1, 0}, {{"scenario.yaml", "application/yaml", scenario}});
  writer.add_channel({1, "boat/pose", msg::Pose::kType, "", 0, 1000});
  writer.add_channel({2, "nav/estimate", msg::Estimate::kType, "", 0, 1000});
  if (two_boats) writer.add_channel({3, "ship/pose", msg::Pose::kType, "", 0, 1000});
  for (int i = 0; i <= 100; ++i) {
    const SimTime t = 100_ms * i;
    msg::Pose pose;
    pose.stamp_ns = t.count();
    pose.position_enu_m = {50.0 + 0.2 * i, 10.0, -4.0 + 0.01 * i};
    pose.enu_from_body =
        frames::wxyz_of(frames::enu_from_body({.heading_rad = 1.5, .pitch_rad = 0.1, .roll_rad = -0.2}));
    writer.write(1, static_cast<std::uint64_t>(i), t, msg::encode_inline(msg::encode(pose)));
    msg::Estimate estimate;
    estimate.stamp_ns = pose.stamp_ns;
    estimate.position_enu_m = {pose.position_enu_m[0], 13.0, pose.position_enu_m[2]};
    estimate.enu_from_body = pose.enu_from_body;
    writer.write(2, static_cast<std::uint64_t>(i), t, msg::encode_inline(msg::encode(estimate)));
  }
  writer.close();
}

std::string fault_of(const std::string& file, const std::string& topic) {
  try {
    read_track(file, topic);
  } catch (const UserError& error) {
    return std::string(error.what()).substr(file.size());
  }
  return "";
}

const std::string kSite = "site: { latitude_deg: 48.6, longitude_deg: -3.9 }\n";

}  // namespace

TEST_CASE("a record's poses are followed where they were, with attitude and height, at another origin too") {
  const record::TestFolder folder;
  write_record(folder / "a.mcap", kSite, false);
  const Track track = read_track(folder / "a.mcap");
  const FollowedTrack here(track, {}, frames::Geodetic{48.6, -3.9}, 10.0);
  const frames::MovingPose at = here.at(5.05);
  CHECK_THAT(at.pose.position_enu_m.x(), WithinAbs(60.1, 1e-6));
  CHECK_THAT(at.pose.position_enu_m.z(), WithinAbs(-3.495, 1e-6));
  CHECK_THAT(at.velocity_enu_mps.x(), WithinAbs(2.0, 1e-6));
  CHECK(here.height() == FollowedTrack::Height::kDatum);
  const frames::Attitude attitude = frames::attitude_of(at.pose.enu_from_body);
  CHECK_THAT(attitude.heading_rad, WithinAbs(1.5, 1e-9));
  CHECK_THAT(attitude.roll_rad, WithinAbs(-0.2, 1e-9));

  const frames::LocalProjection old_world({48.6, -3.9}), new_world({48.5, -3.8});
  const FollowedTrack there(track, {}, new_world.origin(), 10.0);
  const frames::Vec2 expected = new_world.enu_of(old_world.geodetic_of({60.1, 10.0}));
  CHECK((there.at(5.05).pose.position_enu_m.head<2>() - expected).norm() < 1e-3);
}

TEST_CASE("a record whose world has no origin of its own is in world metres") {
  const record::TestFolder folder;
  write_record(folder / "a.mcap", "site: { origin: raster }\n", false);
  const Track track = read_track(folder / "a.mcap");
  CHECK(track.fixes.empty());
  CHECK(track.spots.size() == 101);
}

TEST_CASE("estimates are followed by their topic's name; of two vehicles' poses one is named") {
  const record::TestFolder folder;
  write_record(folder / "a.mcap", kSite, true);
  const std::string file = folder / "a.mcap";
  const FollowedTrack estimated(read_track(file, "nav/estimate"), {}, frames::Geodetic{48.6, -3.9}, 10.0);
  CHECK_THAT(estimated.at(5.0).pose.position_enu_m.y(), WithinAbs(13.0, 1e-6));
  CHECK(fault_of(file, "") == ": has several topics of poses; allowed as topic: boat/pose, nav/estimate, ship/pose");
  CHECK(fault_of(file, "bow/ping") ==
        ": has no poses or estimates of topic bow/ping; allowed as topic: boat/pose, nav/estimate, ship/pose");
  CHECK(fault_of(file, "ship/pose") == ": ship/pose has no message");
}
