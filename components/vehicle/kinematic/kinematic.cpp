#include "components/vehicle/kinematic/kinematic.h"

namespace ensonify {

KinematicDynamics::KinematicDynamics(const VehicleConfig& config, const motion::State& start, SimTime now)
    : limits_(config.limits),
      water_(config.water),
      state_(start),
      floating_(water_.tide, water_.floats, start.speed_mps, seconds(now)),
      command_{start.heading_rad, start.speed_mps, start.position_enu_m.z()},
      now_(now) {}

double KinematicDynamics::depth_below_datum_m() const {
  return -(water_.tide.at(seconds(now_)).height_m + state_.position_enu_m.z());
}

void KinematicDynamics::advance(SimTime now) {
  const double dt_s = seconds(now - now_);
  if (!water_.current.none()) {
    state_.position_enu_m.head<2>() += water_.current.drift_enu_m(depth_below_datum_m(), seconds(now_), dt_s);
  }
  state_ = motion::advance(state_, command_, dt_s, limits_);
  now_ = now;
  floating_.advance(state_.speed_mps, seconds(now));
}

void KinematicDynamics::command(double heading_rad, double speed_mps, std::optional<double> depth_m) {
  command_.heading_rad = heading_rad;
  command_.speed_mps = speed_mps;
  if (depth_m) command_.height_m = -*depth_m;
}

frames::MovingPose KinematicDynamics::moving() const {
  const double t_s = seconds(now_);
  frames::MovingPose moving = motion::moving_pose(state_, command_, limits_);
  const vertical::Afloat afloat = floating_.at_last();
  moving.pose.position_enu_m.z() += afloat.height_m;
  moving.velocity_enu_mps.z() += afloat.rate_mps;
  moving.acceleration_enu_mps2.z() += afloat.acceleration_mps2;
  if (!water_.current.none()) {
    moving.velocity_enu_mps.head<2>() += water_.current.velocity_enu_mps(depth_below_datum_m(), t_s);
    moving.acceleration_enu_mps2.head<2>() += water_.current.acceleration_enu_mps2(t_s);
  }
  return moving;
}

}  // namespace ensonify
