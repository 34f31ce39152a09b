#include "components/vehicle/kinematic/kinematic.h"

namespace ensonify {
namespace {

/// How the tide's rate changes, over two seconds: of constituents to 1e-8 of it; the lines of a gauge bend within them.
double tide_acceleration_mps2(const vertical::Tide& tide, double t_s) {
  return 0.5 * (tide.at(t_s + 1.0).rate_mps - tide.at(t_s - 1.0).rate_mps);
}

}  // namespace

KinematicDynamics::KinematicDynamics(const VehicleConfig& config, const motion::State& start, SimTime now)
    : limits_(config.limits),
      water_(config.water),
      state_(start),
      command_{start.heading_rad, start.speed_mps, start.position_enu_m.z()},
      now_(now) {
  settling_ = vertical::Settling(settlement_m());
}

/// That of its speed, once the hull has come to it.
double KinematicDynamics::settlement_m() const {
  if (!water_.floats) return 0.0;
  return vertical::sinkage_m({water_.floats->settlement, 0.0, 0.0}, state_.speed_mps, 0.0);
}

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
  settling_.advance(settlement_m(), dt_s);
}

void KinematicDynamics::command(double heading_rad, double speed_mps, std::optional<double> depth_m) {
  command_.heading_rad = heading_rad;
  command_.speed_mps = speed_mps;
  if (depth_m) command_.height_m = -*depth_m;
}

frames::MovingPose KinematicDynamics::moving() const {
  const double t_s = seconds(now_);
  frames::MovingPose moving = motion::moving_pose(state_, command_, limits_);
  vertical::Level level = water_.tide.at(t_s);
  if (water_.floats) {
    const vertical::Loading& load = *water_.floats;
    level.height_m -= settling_.lower_m() + load.change_m + load.rate_mps * t_s;
    level.rate_mps -= settling_.rate_mps() + load.rate_mps;
  }
  moving.pose.position_enu_m.z() += level.height_m;
  moving.velocity_enu_mps.z() += level.rate_mps;
  moving.acceleration_enu_mps2.z() += tide_acceleration_mps2(water_.tide, t_s) - settling_.acceleration_mps2();
  if (!water_.current.none()) {
    moving.velocity_enu_mps.head<2>() += water_.current.velocity_enu_mps(depth_below_datum_m(), t_s);
    moving.acceleration_enu_mps2.head<2>() += water_.current.acceleration_enu_mps2(t_s);
  }
  return moving;
}

}  // namespace ensonify
