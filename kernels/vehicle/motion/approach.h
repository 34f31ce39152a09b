#pragma once

#include "kernels/vehicle/motion/excursion.h"

/// The quickest way of a height or a heading to where it is wanted, at rest there, with limited rate and acceleration.
namespace ensonify::motion {

/// Value and rate after dt on the way to `target`, and the acceleration in force from then on: full acceleration, then
/// the highest rate, then full deceleration, ending at rest at the target. What moves the wrong way, or too fast to
/// stop in time, is braked first and then comes back. Exact, so one step of dt equals any number of steps that sum to
/// dt. `fastest` and `acceleration` must be above 0, in the units of the value per second and per second squared; an
/// infinite acceleration changes the rate at once.
Moving approach(const Moving& from, double target, double dt_s, double fastest, double acceleration);

}  // namespace ensonify::motion
