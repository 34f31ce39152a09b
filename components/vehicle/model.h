#pragma once

#include "components/runtime/sim_time.h"
#include "components/vehicle/config.h"
#include "messages/motion.h"

namespace ensonify {

/// A vehicle that obeys heading and speed at once, within its acceleration and turning circle, and rolls and heaves in
/// waves. It holds its depth.
class VehicleModel {
 public:
  /// At sim time `now`, going on straight ahead until told otherwise.
  VehicleModel(const VehicleConfig& config, const motion::State& start, SimTime now);

  /// Moves on to `now` under the command in force.
  void advance(SimTime now);
  /// Puts a new command in force, from now on.
  void command(const msg::Guidance& guidance);

  msg::Pose pose() const;

 private:
  motion::Limits limits_;
  double fastest_mps_;
  motion::Waves waves_;
  motion::State state_;
  motion::Command command_;
  SimTime now_;
};

}  // namespace ensonify
