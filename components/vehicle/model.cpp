#include "components/vehicle/model.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "components/errors/assert.h"
#include "components/truth/pose_message.h"
#include "components/vehicle/hydrodynamic/hydrodynamic.h"
#include "components/vehicle/kinematic/kinematic.h"
#include "components/vehicle/recorded/recorded.h"

namespace ensonify {

std::unique_ptr<Dynamics> make_dynamics(const VehicleConfig& config, const motion::State& start, SimTime now) {
  if (config.followed) return std::make_unique<RecordedDynamics>(config, now);
  if (config.hydrodynamics) return std::make_unique<HydrodynamicDynamics>(config, start, now);
  return std::make_unique<KinematicDynamics>(config, start, now);
}

VehicleModel::VehicleModel(const VehicleConfig& config, const motion::State& start, SimTime now)
    : dynamics_(make_dynamics(config, start, now)),
      by_forces_(dynamic_cast<HydrodynamicDynamics*>(dynamics_.get())),
      fastest_mps_(config.fastest_mps),
      floats_(config.water.floats.has_value()),
      waves_(config.waves),
      disturbance_(config.disturbance, random::Stream(config.seed, "vehicle/" + config.name + "/disturbance")),
      added_(!config.followed                          ? Added::kAll
             : config.followed->attitude_is_recorded() ? Added::kNothing
                                                       : Added::kAttitudeAndHeave),
      now_(now) {}

void VehicleModel::advance(SimTime now) {
  dynamics_->advance(now);
  now_ = now;
}

void VehicleModel::obey(const Order& order) {
  if (const auto* guidance = std::get_if<msg::Guidance>(&order)) return command(*guidance);
  ENSONIFY_ASSERT(by_forces_ != nullptr, "orders of actuators go to a vehicle moved by forces");
  if (const auto* actuators = std::get_if<msg::Actuators>(&order)) {
    Eigen::VectorXd orders(static_cast<Eigen::Index>(actuators->propeller_rps.size() + actuators->fin_rad.size()));
    std::copy_n(actuators->fin_rad.data(), actuators->fin_rad.size(),
                std::copy_n(actuators->propeller_rps.data(), actuators->propeller_rps.size(), orders.data()));
    return by_forces_->actuate(std::move(orders));
  }
  by_forces_->stop();
}

void VehicleModel::command(const msg::Guidance& guidance) {
  std::optional<double> depth_m;
  if (!floats_ && std::isfinite(guidance.depth_m)) depth_m = std::max(0.0, guidance.depth_m);
  dynamics_->command(guidance.heading_grid_rad, std::clamp(guidance.speed_mps, 0.0, fastest_mps_), depth_m);
}

msg::Pose VehicleModel::pose() const {
  if (added_ == Added::kNothing) return pose_message(now_, dynamics_->moving());
  const double t_s = seconds(now_);
  motion::Excursion excursion = waves_.at(t_s) + disturbance_.at(t_s);
  if (added_ == Added::kAttitudeAndHeave) excursion.surge_m = excursion.sway_m = excursion.heading_rad = {};
  return pose_message(now_, motion::superimpose(dynamics_->moving(), excursion));
}

}  // namespace ensonify
