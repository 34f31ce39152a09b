#include "components/sonar/head_inputs.h"

#include <fmt/format.h>

#include <algorithm>

#include "components/runtime/log.h"
#include "components/sonar/head_motion.h"
#include "messages/motion.h"
#include "messages/navigation.h"

namespace ensonify {
namespace {

constexpr SimTime kCommandDelay = 100_ms;

/// Covariances that are all zero are not given.
std::optional<uncertainty::Navigation> errors_of(const msg::Estimate& estimate) {
  uncertainty::Navigation errors;
  errors.position_enu_m2 = Eigen::Map<const Eigen::Matrix3d>(estimate.position_covariance_enu_m2.data());
  errors.rotation_enu_rad2 = Eigen::Map<const Eigen::Matrix3d>(estimate.rotation_covariance_enu_rad2.data());
  if (errors.position_enu_m2.isZero(0.0) && errors.rotation_enu_rad2.isZero(0.0)) return std::nullopt;
  return errors;
}

/// Of all channels' carriers.
double shortest_wave_m(const HeadInputs::Start& start) {
  double highest_hz = 1.0;
  for (const HeadInputs::Channel& channel : start.channels) {
    for (const msg::SectorDeclaration& sector : channel.sectors) highest_hz = std::max(highest_hz, sector.frequency_hz);
  }
  return start.sound_speed_mps / highest_hz;
}

}  // namespace

HeadInputs::HeadInputs(Ports& ports, const Start& start)
    : ports_(ports),
      mounting_(start.mounting),
      truth_((2 * start.longest_ping + 1_s).count()),
      estimate_((2 * start.longest_ping + 1_s).count()),
      tiles_(start.lod, shortest_wave_m(start)),
      tide_(start.tide),
      start_mps_(start.sound_speed_mps) {
  for (const Channel& channel : start.channels) {
    names_.push_back(channel.name);
    settings_.emplace_back(channel.settings, channel.limits);
  }
  ports.in<msg::Pose>("pose", [this](const msg::Pose& pose) { push(truth_, pose); });
  ports.in<msg::Estimate>("estimate",
                          [this](const msg::Estimate& estimate) {
                            push(estimate_, estimate);
                            navigation_errors_ = errors_of(estimate);
                          },
                          {.optional = true});
  ports.in<msg::Tile>("tile", [this](const msg::Tile& tile) { tiles_.insert(tile); });
  ports.in<msg::TileRelease>("release", [this](const msg::TileRelease& release) { tiles_.release(release); });
  ports.in<msg::Mesh>("mesh", [this](const msg::Mesh& mesh) { tiles_.insert(mesh); }, {.optional = true});
  ports.in<msg::MeshRelease>("mesh_release", [this](const msg::MeshRelease& release) { tiles_.release(release); },
                             {.optional = true});
  ports.in<msg::ObjectMesh>("object_mesh", [this](const msg::ObjectMesh& mesh) { tiles_.insert(mesh); },
                            {.optional = true});
  ports.in<msg::Object>("object", [this](const msg::Object& object) { tiles_.insert(object); }, {.optional = true});
  ports.in<msg::ObjectRelease>("object_release", [this](const msg::ObjectRelease& release) { tiles_.release(release); },
                               {.optional = true});
  if (start.probe) {
    ports.in<msg::SoundSpeed>("sound_speed",
                              [this](const msg::SoundSpeed& probe) { probe_mps_ = probe.sound_speed_mps; },
                              {.optional = true});
  }
  ports.in<msg::SonarSettings>("settings", [this](const msg::SonarSettings& wanted) { command(wanted); },
                               {.delay = kCommandDelay, .optional = true});
}

void HeadInputs::command(const msg::SonarSettings& wanted) {
  for (std::size_t i = 0; i < settings_.size(); ++i) {
    const std::string channel = names_[i].empty() ? "" : "channel=" + names_[i] + " ";
    for (const std::string& remark : settings_[i].command(wanted)) {
      log::event(ports_, "settings", "{}{}", channel, remark);
      ports_.count("settings_not_as_wanted");
    }
  }
}

void HeadInputs::fill_track(msg::HeadTrack& track, SimTime transmit, SimTime reception) const {
  fill(track, estimate_, mounting_.measured, transmit, reception);
}

std::string HeadInputs::obstacle(SimTime now) const {
  const auto body = truth_.at(now.count(), frames::PoseHistory::Outside::kNearest);
  if (!body) return "no pose of the vehicle has arrived";
  const frames::Vec3 place = frames::head_pose(*body, mounting_.actual).position_enu_m;
  const double above_water_m = place.z() - tide_.at(seconds(now)).height_m;
  if (above_water_m > 0.0) return fmt::format("the head is {:.2f} m above the water", above_water_m);
  if (!tiles_.covers(place.head<2>())) {
    return fmt::format("no seabed tile under the head at ({:.0f}, {:.0f}) m", place.x(), place.y());
  }
  return "";
}

}  // namespace ensonify
