#include "components/vehicle/kinematic/kinematic.h"

namespace ensonify {
namespace {

constexpr SimTime kPiece = 10_ms;  // of a way through a sheared current

}  // namespace

KinematicDynamics::KinematicDynamics(const VehicleConfig& config, const motion::State& start, SimTime now)
    : limits_(config.limits),
      water_(config.water),
      state_(start),
      floating_(water_.tide, water_.floats, start.speed_mps, seconds(now)),
      command_{start.heading_rad, start.speed_mps, start.position_enu_m.z()},
      now_(now) {}

double KinematicDynamics::depth_below_datum_m(const motion::State& state, double t_s) const {
  return -(water_.tide.at(t_s).height_m + state.position_enu_m.z());
}

void KinematicDynamics::advance(SimTime now) {
  while (water_.current.sheared() && now_ + kPiece < now) move(now_ + kPiece);
  move(now);
}

void KinematicDynamics::move(SimTime now) {
  if (!water_.current.none()) state_.position_enu_m.head<2>() += drift_enu_m(now);
  state_ = motion::advance(state_, command_, seconds(now - now_), limits_);
  now_ = now;
  floating_.advance(state_.speed_mps, seconds(now));
}

frames::Vec2 KinematicDynamics::drift_enu_m(SimTime until) const {
  const double t_s = seconds(now_), dt_s = seconds(until - now_);
  const auto at_depth_after = [&](double s) -> frames::Vec2 {
    const motion::State then = s == 0.0 ? state_ : motion::advance(state_, command_, s, limits_);
    return water_.current.drift_enu_m(depth_below_datum_m(then, t_s + s), t_s, dt_s);
  };
  if (!water_.current.sheared()) return at_depth_after(0.0);
  return (at_depth_after(0.0) + 4.0 * at_depth_after(0.5 * dt_s) + at_depth_after(dt_s)) / 6.0;
}

void KinematicDynamics::command(double heading_rad, double speed_mps, std::optional<double> depth_m) {
  command_.heading_rad = heading_rad;
  command_.speed_mps = speed_mps;
  if (depth_m) command_.height_m = -*depth_m;
}

frames::MovingPose KinematicDynamics::moving() const {
  const double t_s = seconds(now_);
  frames::MovingPose moving = motion::moving_pose(state_, command_, limits_);
  const double climb_mps = moving.velocity_enu_mps.z();
  const vertical::Level afloat = floating_.at_last();
  moving.pose.position_enu_m.z() += afloat.height_m;
  moving.velocity_enu_mps.z() += afloat.rate_mps;
  moving.acceleration_enu_mps2.z() += afloat.acceleration_mps2;
  if (!water_.current.none()) {
    const double depth_m = depth_below_datum_m(state_, t_s), sinking_mps = -(climb_mps + water_.tide.at(t_s).rate_mps);
    moving.velocity_enu_mps.head<2>() += water_.current.velocity_enu_mps(depth_m, t_s);
    moving.acceleration_enu_mps2.head<2>() += water_.current.acceleration_enu_mps2(depth_m, sinking_mps, t_s);
  }
  return moving;
}

}  // namespace ensonify
