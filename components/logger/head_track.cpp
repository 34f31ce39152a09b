#include "components/logger/head_track.h"

namespace ensonify::logger {

bool has_track(const msg::HeadTrack& track) {
  return track.pose_position_enu_m.size() >= 3 && track.pose_enu_from_head.size() >= 4;
}

frames::Pose body_pose_of(const msg::HeadTrack& track, const Vessel& vessel) {
  const auto& position = track.pose_position_enu_m;
  const auto& rotation = track.pose_enu_from_head;
  return vessel.body_pose({frames::Vec3(position[0], position[1], position[2]),
                           frames::quaternion_of({rotation[0], rotation[1], rotation[2], rotation[3]})});
}

}  // namespace ensonify::logger
