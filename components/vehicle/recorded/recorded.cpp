#include "components/vehicle/recorded/recorded.h"

namespace ensonify {

RecordedDynamics::RecordedDynamics(const VehicleConfig& config, SimTime now)
    : track_(config.followed),
      water_(config.water),
      depth_m_(config.plan.mission.depth_m),
      now_(now),
      floating_(water_.tide, water_.floats, speed_through_water_mps(), seconds(now)) {}

double RecordedDynamics::speed_through_water_mps() const {
  const double t_s = seconds(now_);
  const frames::Vec2 over_ground = track_->at(t_s).velocity_enu_mps.head<2>();
  return (over_ground - water_.current.velocity_enu_mps(0.0, t_s)).norm();
}

void RecordedDynamics::advance(SimTime now) {
  now_ = now;
  floating_.advance(speed_through_water_mps(), seconds(now));
}

frames::MovingPose RecordedDynamics::moving() const {
  using Height = tracks::FollowedTrack::Height;
  frames::MovingPose moving = track_->at(seconds(now_));
  if (track_->height() == Height::kDatum) return moving;
  const bool by_mission = track_->height() == Height::kWaterLevel && !water_.floats;
  const vertical::Level level =
      track_->height() == Height::kWaterLevel ? floating_.at_last() : water_.tide.at(seconds(now_));
  moving.pose.position_enu_m.z() += level.height_m - (by_mission ? depth_m_ : 0.0);
  moving.velocity_enu_mps.z() += level.rate_mps;
  moving.acceleration_enu_mps2.z() += level.acceleration_mps2;
  return moving;
}

}  // namespace ensonify
