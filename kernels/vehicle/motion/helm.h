#pragma once

#include "kernels/vehicle/motion/hydrodynamics.h"
#include "kernels/vehicle/motion/kinematics.h"

namespace ensonify::motion {

/// Controller of a vehicle: heading, speed and depth by its propellers and fins.
struct HelmParameters {
  enum class Depth {
    kNone,     // it floats
    kByHeave,  // thrusters push it up and down, and keep it level
    kByPitch,  // it goes there, bow up or down
  };
  double surge_ps = 0.5;  // how fast each error falls, 1/s, > 0
  double heading_ps = 0.3;
  double turn_rate_radps = 0.2;  // highest ordered, > 0
  Depth depth = Depth::kNone;
  double depth_ps = 0.1;
  double climb_mps = 0.5;     // fastest ordered, > 0
  double pitch_ps = 0.6;      // also of roll and pitch that are kept level
  double steepest_rad = 0.4;  // by pitch only, > 0
};

/// Orders for the actuators (Body::step) that bring a body to a command.
///
/// A cascade per axis: the error asks for a rate, within its limit, and the rate's error for an acceleration four times
/// as fast, which is critical damping. What force this takes follows from the body's own equations (the forces that act
/// anyway are taken off), and is spread over propellers and fins by weighted least squares, each weighted by its own
/// largest force. Commanded a speed beyond what its propellers make, a body goes as fast as it can and still holds
/// heading and depth. It sees the true state: errors of the vehicle's sensors come in through what it is commanded to
/// steer. Speed is through the water. Axes that nothing pushes stay as they are.
Eigen::VectorXd orders(const HelmParameters& helm, const Body& body, const BodyState& state, const Command& command,
                       const Surroundings& around);

/// Highest speed through still water, level and straight ahead, at which all propellers together balance the drag.
double top_speed_mps(const Body& body);

/// Radius of the circle that a body goes round on in still water, commanded a speed and always a heading a quarter turn
/// to starboard: integrated for two minutes.
double tightest_circle_m(const HelmParameters& helm, const Body& body, double speed_mps);

}  // namespace ensonify::motion
