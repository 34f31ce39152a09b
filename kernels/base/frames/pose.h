#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "kernels/base/frames/attitude.h"

namespace ensonify::frames {

/// Position of a body's reference point and the body's attitude.
struct Pose {
  Vec3 position_enu_m = Vec3::Zero();
  Quaternion enu_from_body = enu_from_ned();  // level, bow to north
};

/// A pose and how it changes: the velocity and acceleration of the reference point, and how the body turns.
struct MovingPose {
  Pose pose;
  Vec3 velocity_enu_mps = Vec3::Zero();
  Vec3 angular_rate_body_radps = Vec3::Zero();
  Vec3 acceleration_enu_mps2 = Vec3::Zero();
  Vec3 angular_acceleration_body_radps2 = Vec3::Zero();
};

/// Mounting of a head's transducer on the body: place and rotation. Actual and measured mountings are two of these.
struct Mounting {
  Vec3 position_body_m = Vec3::Zero();
  Quaternion body_from_head = Quaternion::Identity();
};

/// Pose of a head's transducer in the world.
struct HeadPose {
  Vec3 position_enu_m = Vec3::Zero();
  Quaternion enu_from_head = enu_from_ned();
};

/// enu_from_head = enu_from_body * body_from_head.
HeadPose head_pose(const Pose& body, const Mounting& mounting);

Vec3 enu_from_body(const Pose& pose, const Vec3& point_body_m);
Vec3 enu_from_head(const HeadPose& pose, const Vec3& point_head_m);
Vec3 head_from_enu(const HeadPose& pose, const Vec3& point_enu_m);

/// Position on the straight line from a to b, rotation on the shortest arc; fraction 0 is a, 1 is b, others
/// extrapolate.
Pose interpolate(const Pose& a, const Pose& b, double fraction);

/// Poses by time, oldest forgotten. Times are simulation nanoseconds.
class PoseHistory {
 public:
  /// Choice for a time outside the stored span.
  enum class Outside { kNothing, kNearest };

  /// Keeps at least `keep_ns` behind the newest pose.
  explicit PoseHistory(std::int64_t keep_ns) : keep_ns_(keep_ns) {}

  /// Times must rise; a pose at or before the newest time is refused (false).
  bool push(std::int64_t t_ns, const Pose& pose);

  /// The interpolated pose at t. Empty when there is no pose, or t is outside the span and `outside` is kNothing.
  std::optional<Pose> at(std::int64_t t_ns, Outside outside = Outside::kNothing) const;

  bool empty() const { return entries_.empty(); }
  std::int64_t oldest_ns() const { return entries_.front().t_ns; }  // not when empty
  std::int64_t newest_ns() const { return entries_.back().t_ns; }   // not when empty

 private:
  struct Entry {
    std::int64_t t_ns;
    Pose pose;
  };
  std::int64_t keep_ns_;
  std::deque<Entry> entries_;
};

}  // namespace ensonify::frames
