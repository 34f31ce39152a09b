#pragma once

#include "kernels/base/frames/local_projection.h"
#include "kernels/base/frames/pose.h"
#include "kernels/instruments/inertial/strapdown.h"
#include "kernels/vehicle/vertical/reduction.h"
#include "messages/motion.h"
#include "messages/navigation.h"

namespace ensonify {

/// True rotation from north-east-down at a place of the world to the world's axes: down is down, and grid north is
/// turned from true north by the map's convergence.
frames::Quaternion enu_from_true_ned(const frames::LocalProjection& world, const frames::Vec2& place_enu_m);

/// State of an instrument on a body, on the ellipsoid. Heights count from chart datum.
inertial::NavigationState geodetic_state(const frames::MovingPose& body, const frames::Mounting& mounting,
                                         const frames::LocalProjection& world);

frames::MovingPose moving_pose(const msg::Pose& pose);

/// Completes a position whose place in the world is set by its latitude, longitude and heights.
void report_position(msg::Position& position, const frames::LocalProjection& world, const vertical::Datums& datums);

}  // namespace ensonify
