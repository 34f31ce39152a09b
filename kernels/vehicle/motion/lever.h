#pragma once

#include "kernels/base/frames/pose.h"

namespace ensonify::motion {

/// The motion of a body's reference point, by that of the point of it which is at `lever_body_m` from there.
frames::MovingPose reference_point(const frames::MovingPose& of_point, const frames::Vec3& lever_body_m);

}  // namespace ensonify::motion
