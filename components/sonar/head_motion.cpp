#include "components/sonar/head_motion.h"

#include "components/config/config_reader.h"

namespace ensonify {

HeadMounting read_mounting(const ConfigReader& from, const World& world, const std::string& process) {
  if (const auto found = world.mounting(process)) return found->second;
  from.problem(
      "", "the scenario mounts no head named " + process + " on a vehicle; add vehicles.NAME.mountings." + process);
  return {};
}

void head_poses(const frames::PoseHistory& vehicle, const frames::Mounting& mounting, SimTime first, SimTime duration,
                std::vector<frames::HeadPose>& poses) {
  poses.clear();
  for (SimTime t{0}; t < duration + kTrackPeriod; t += kTrackPeriod) {
    const auto body = vehicle.at((first + t).count(), frames::PoseHistory::Outside::kNearest);
    if (!body) return;
    poses.push_back(frames::head_pose(*body, mounting));
  }
}

void fill(msg::HeadTrack& track, const frames::PoseHistory& estimate, const frames::Mounting& measured, SimTime first,
          SimTime duration) {
  std::vector<frames::HeadPose> poses;
  head_poses(estimate, measured, first, duration, poses);
  if (poses.empty()) return;
  track.pose_time_s = msg::Array<double>({poses.size()});
  track.pose_position_enu_m = msg::Array<double>({poses.size(), 3});
  track.pose_enu_from_head = msg::Array<double>({poses.size(), 4});
  for (std::size_t i = 0; i < poses.size(); ++i) {
    track.pose_time_s[i] = seconds(kTrackPeriod) * static_cast<double>(i);
    const auto wxyz = frames::wxyz_of(poses[i].enu_from_head);
    for (std::size_t k = 0; k < 3; ++k) {
      track.pose_position_enu_m(i, k) = poses[i].position_enu_m[static_cast<Eigen::Index>(k)];
    }
    for (std::size_t k = 0; k < 4; ++k) track.pose_enu_from_head(i, k) = wxyz[k];
  }
}

}  // namespace ensonify
