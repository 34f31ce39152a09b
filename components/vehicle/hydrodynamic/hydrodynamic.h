#pragma once

#include <optional>

#include "components/vehicle/dynamics.h"
#include "kernels/vehicle/motion/helm.h"

namespace ensonify {

/// A vehicle moved by forces, steered by its own helm. Integrated in steps of 10 ms that start with the vehicle, so
/// that the pose rate does not change the path.
class HydrodynamicDynamics : public Dynamics {
 public:
  HydrodynamicDynamics(const VehicleConfig& config, const motion::State& start, SimTime now);

  void advance(SimTime now) override;
  void command(double heading_rad, double speed_mps, std::optional<double> depth_m) override;
  frames::MovingPose moving() const override;

  /// Puts orders of propellers (rev/s) and then fins (rad) in force from now on, in the place of its helm's.
  void actuate(Eigen::VectorXd orders);
  /// From now on its helm stops it on its heading, at its depth.
  void stop();

 private:
  struct Order {
    motion::Command command;                   // of the helm; its height counts from the water level
    std::optional<Eigen::VectorXd> actuators;  // in its place
  };
  double height_m() const;
  motion::Surroundings around(const motion::BodyState& state, SimTime t) const;
  /// One step of the integration from the grid's time, with the orders that the helm gives then.
  motion::BodyState stepped(SimTime dt) const;

  motion::Body body_;
  motion::HelmParameters helm_;
  VehicleWater water_;
  Order order_;
  Order next_;  // in force from the first step that begins at or after next_from_
  SimTime next_from_{};
  SimTime grid_;  // the time of state_
  SimTime now_;
  motion::BodyState state_;
};

}  // namespace ensonify
