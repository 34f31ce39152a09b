#include "components/runtime/head/head_inputs.h"

#include <fmt/format.h>

#include "components/runtime/log.h"
#include "messages/motion.h"
#include "messages/navigation.h"

namespace ensonify {
namespace {

constexpr SimTime kCommandDelay = std::chrono::milliseconds(100);

frames::Pose pose_of(const std::array<double, 3>& position, const std::array<double, 4>& wxyz) {
  return {{position[0], position[1], position[2]}, frames::quaternion_of(wxyz)};
}

}  // namespace

HeadInputs::HeadInputs(Ports& ports, const Start& start)
    : ports_(ports),
      actual_(start.actual),
      truth_(start.keep.count()),
      estimate_(start.keep.count()),
      sound_speed_mps_(start.sound_speed_mps),
      settings_(start.settings, start.limits) {
  ports.in<msg::Pose>("pose", [this](const msg::Pose& pose) {
    truth_.push(pose.stamp_ns, pose_of(pose.position_enu_m, pose.enu_from_body));
  });
  ports.in<msg::Estimate>("estimate",
                          [this](const msg::Estimate& estimate) {
                            estimate_.push(estimate.stamp_ns, pose_of(estimate.position_enu_m, estimate.enu_from_body));
                          },
                          {.optional = true});
  ports.in<msg::Tile>("tile", [this](const msg::Tile& tile) { tiles_.insert(tile); });
  ports.in<msg::TileRelease>("release", [this](const msg::TileRelease& release) { tiles_.release(release); });
  ports.in<msg::SoundSpeed>("sound_speed",
                            [this](const msg::SoundSpeed& probe) { sound_speed_mps_ = probe.sound_speed_mps; },
                            {.optional = true});
  ports.in<msg::SonarSettings>("settings", [this](const msg::SonarSettings& wanted) { command(wanted); },
                               {.delay = kCommandDelay, .optional = true});
}

void HeadInputs::command(const msg::SonarSettings& wanted) {
  for (const std::string& remark : settings_.command(wanted)) {
    log::event(ports_, "settings", "{}", remark);
    ports_.count("settings_not_as_wanted");
  }
}

std::string HeadInputs::obstacle(SimTime now) const {
  const auto body = truth_.at(now.count(), frames::PoseHistory::Outside::kNearest);
  if (!body) return "no pose of the vehicle has arrived";
  const frames::Vec3 place = frames::head_pose(*body, actual_).position_enu_m;
  if (place.z() > 0.0) return fmt::format("the head is {:.1f} m above the water", place.z());
  if (!tiles_.covers(place.head<2>())) {
    return fmt::format("no seabed tile under the head at ({:.0f}, {:.0f}) m", place.x(), place.y());
  }
  return "";
}

}  // namespace ensonify
