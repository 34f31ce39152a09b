#pragma once

#include "kernels/vehicle/motion/excursion.h"

namespace ensonify::motion {

/// Point of the cubic that has these values and rates at the ends of an interval [deBoor2001, chapter IV]: value, rate
/// and acceleration at `u`, in [0, length]. `length` > 0, and rates per unit of it, whatever it is: a time or a depth.
/// What the ends have of accelerations is not used.
Moving cubic_between(const Moving& from, const Moving& to, double length, double u);

}  // namespace ensonify::motion
