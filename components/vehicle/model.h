#pragma once

#include <memory>

#include "components/runtime/sim_time.h"
#include "components/vehicle/config.h"
#include "components/vehicle/dynamics.h"
#include "components/vehicle/pilots.h"
#include "messages/motion.h"

namespace ensonify {

class HydrodynamicDynamics;

/// A vehicle: its dynamics, and what waves add to them.
class VehicleModel {
 public:
  /// At sim time `now`, going on straight ahead until commanded otherwise.
  VehicleModel(const VehicleConfig& config, const motion::State& start, SimTime now);

  /// Moves on to `now` under the command in force.
  void advance(SimTime now);
  /// Puts a new order in force, from now on. Actuators are of a vehicle that is moved by forces.
  void obey(const Order& order);
  /// A vehicle that floats does not dive.
  void command(const msg::Guidance& guidance);

  msg::Pose pose() const;

 private:
  std::unique_ptr<Dynamics> dynamics_;
  HydrodynamicDynamics* by_forces_;  // the same, or nullptr
  double fastest_mps_;
  bool floats_;
  motion::Waves waves_;
  motion::Disturbance disturbance_;
  enum class Added { kAll, kAttitudeAndHeave, kNothing };
  Added added_;  // of waves and disturbance; of a recorded track the place stays as it was recorded
  SimTime now_;
};

}  // namespace ensonify
