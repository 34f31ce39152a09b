#pragma once

#include "kernels/base/frames/pose.h"

/// Motion about a mean path, as waves, gusts and a helmsman cause it.
namespace ensonify::motion {

/// A value that moves, with its first and second derivative in time.
struct Moving {
  double value = 0.0;
  double rate = 0.0;
  double acceleration = 0.0;

  Moving operator+(const Moving& other) const {
    return {value + other.value, rate + other.rate, acceleration + other.acceleration};
  }
};

/// Excursion of a body from its mean pose. All zero: none.
struct Excursion {
  Moving surge_m;      // along the mean body's forward axis
  Moving sway_m;       // along the mean body's starboard axis
  Moving heave_m;      // up, along the world's vertical
  Moving roll_rad;     // starboard down
  Moving pitch_rad;    // bow up
  Moving heading_rad;  // to starboard

  Excursion operator+(const Excursion& other) const;
};

/// The pose of a body that is off its mean pose by an excursion, with exact velocity, acceleration and turn rates: the
/// derivatives of position and attitude, not differences. Turns are yaw, pitch, roll from the mean body's axes, so that
/// for a level mean pose the angles add up.
frames::MovingPose superimpose(const frames::MovingPose& mean, const Excursion& excursion);

/// Point of the cubic that has these values and rates at the ends of an interval [deBoor2001, chapter IV]: value, rate
/// and acceleration at `u`, in [0, length]. `length` > 0, and rates per unit of it, whatever it is: a time or a depth.
/// What the ends have of accelerations is not used.
Moving cubic_between(const Moving& from, const Moving& to, double length, double u);

}  // namespace ensonify::motion
