#pragma once

#include <optional>

#include "kernels/base/frames/local_projection.h"
#include "kernels/base/frames/pose.h"
#include "kernels/instruments/inertial/strapdown.h"
#include "kernels/vehicle/motion/current.h"
#include "kernels/vehicle/vertical/floating.h"
#include "kernels/vehicle/vertical/reduction.h"
#include "kernels/vehicle/vertical/tide.h"
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

/// References of the heights and depths of instruments. World zero is chart datum.
struct Heights {
  vertical::Tide tide;
  vertical::Datums datums;
  motion::Current current;                  // speed through the water, by which a hull settles, is that against it
  std::optional<vertical::Loading> floats;  // not given: no sinkage
  double rest_m = 0.0;                      // of the body's reference point above the water level, at rest

  /// The water level above chart datum at sim time t.
  double water_level_m(double t_s) const { return tide.at(t_s).height_m; }

  /// Velocity of the water at a height above chart datum; it goes along with the tide's streams, not with its height.
  frames::Vec3 water_velocity_enu_mps(double height_m, double t_s) const {
    const frames::Vec2 across = current.velocity_enu_mps(-height_m, t_s);
    return {across.x(), across.y(), 0.0};
  }

  /// The height above chart datum about which a body heaves: with the tide, less what it settles by speed and load.
  double mean_m(const msg::Pose& body) const;
};

}  // namespace ensonify
