#pragma once

#include <memory>
#include <optional>

#include "components/runtime/sim_time.h"
#include "components/vehicle/config.h"
#include "kernels/base/frames/pose.h"

namespace ensonify {

/// Model of a vehicle's motion. One folder each: kinematic, hydrodynamic.
class Dynamics {
 public:
  virtual ~Dynamics() = default;

  /// Moves on to `now` under the command in force.
  virtual void advance(SimTime now) = 0;
  /// Puts a command in force from now on. Speed is through the water, >= 0; depth below the water level, >= 0, or
  /// nothing: as before.
  virtual void command(double heading_rad, double speed_mps, std::optional<double> depth_m) = 0;
  /// Pose and motion of the vehicle, without waves.
  virtual frames::MovingPose moving() const = 0;
};

/// The dynamics that the configuration names. At sim time `now` the vehicle is at `start`, whose height counts from the
/// water level, and goes straight ahead until commanded otherwise.
std::unique_ptr<Dynamics> make_dynamics(const VehicleConfig& config, const motion::State& start, SimTime now);

}  // namespace ensonify
