#pragma once

#include <vector>

#include "components/runtime/sim_time.h"
#include "kernels/base/frames/pose.h"
#include "messages/sonar.h"
#include "scenarios/world/world.h"

namespace ensonify {

class ConfigReader;

/// The mounting of the head that this process is; a problem of the reader when no vehicle carries it.
HeadMounting read_mounting(const ConfigReader& from, const World& world, const std::string& process);

/// Adds the pose that a message gives: pose/1, the truth, or estimate/1.
template <class M>
void push(frames::PoseHistory& history, const M& message) {
  const auto& place = message.position_enu_m;
  history.push(message.stamp_ns, {{place[0], place[1], place[2]}, frames::quaternion_of(message.enu_from_body)});
}

/// Poses of a head at so many times from `first` on, every kTrackPeriod, from those of its vehicle: interpolated, and
/// the nearest one outside of what is known. `poses` is overwritten; without any pose of the vehicle it stays empty.
inline constexpr SimTime kTrackPeriod = std::chrono::milliseconds(5);
void head_poses(const frames::PoseHistory& vehicle, const frames::Mounting& mounting, SimTime first, SimTime duration,
                std::vector<frames::HeadPose>& poses);

/// Writes where the head was while it received, by the navigation estimate and the measured mounting. Without an
/// estimate nothing is written.
void fill(msg::HeadTrack& track, const frames::PoseHistory& estimate, const frames::Mounting& measured, SimTime first,
          SimTime duration);

}  // namespace ensonify
