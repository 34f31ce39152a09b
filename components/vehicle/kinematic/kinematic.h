#pragma once

#include "components/vehicle/dynamics.h"
#include "kernels/vehicle/vertical/floating.h"

namespace ensonify {

/// A vehicle that obeys heading and speed at once, within its limits, and holds its depth below the water level, or
/// floats on it. The current carries it.
class KinematicDynamics : public Dynamics {
 public:
  KinematicDynamics(const VehicleConfig& config, const motion::State& start, SimTime now);

  void advance(SimTime now) override;
  void command(double heading_rad, double speed_mps, std::optional<double> depth_m) override;
  frames::MovingPose moving() const override;

 private:
  /// Depth of the waterline of what floats, of the reference point of what does not: settlement does not count.
  double depth_below_datum_m(const motion::State& state, double t_s) const;
  void move(SimTime now);
  /// Drift by the current from now on: by Simpson's rule over the depths on the way where it is sheared.
  frames::Vec2 drift_enu_m(SimTime until) const;

  motion::Limits limits_;
  VehicleWater water_;
  motion::State state_;  // its height counts from the water level
  vertical::Floating floating_;
  motion::Command command_;
  SimTime now_;
};

}  // namespace ensonify
