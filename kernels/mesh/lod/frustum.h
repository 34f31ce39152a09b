#pragma once

#include "kernels/base/frames/attitude.h"
#include "kernels/mesh/lod/hierarchy.h"

namespace ensonify::lod {

/// Between which speeds of sound a path may pass, and the speed where it starts. All equal: paths are straight.
struct Water {
  double slowest_mps = 1500.0;
  double fastest_mps = 1500.0;
  double at_head_mps = 1500.0;

  bool operator==(const Water&) const = default;
};

/// Frustum of a transmission: directions from one point, up to a length of path. A direction has the sine
/// of its angle from the plane across `axis`, and an angle about the axis, 0 at `zero` and rising towards `side`; the
/// three are unit vectors at right angles. Both are between limits; the angles may lie anywhere and span a full circle.
struct Frustum {
  frames::Vec3 apex_enu_m = frames::Vec3::Zero();
  frames::Vec3 axis_enu = frames::Vec3::UnitX();
  frames::Vec3 zero_enu = frames::Vec3::UnitZ();
  frames::Vec3 side_enu = frames::Vec3::UnitY();
  double low_sine = -1.0, high_sine = 1.0;
  double low_angle_rad = 0.0, high_angle_rad = 0.0;
  double max_range_m = 0.0;
  Water water;

  bool operator==(const Frustum&) const = default;
};

/// A frustum to which many spheres are held: what does not depend on them is worked out once.
class PreparedFrustum {
 public:
  explicit PreparedFrustum(const Frustum& frustum);

  /// Whether a path of the frustum can touch the sphere: never false when one does. Straight paths are judged exactly
  /// but for the corners of the frustum. Of bent ones it is known that they keep their azimuth and that Snell's law
  /// holds between the speeds of `water`, so a path that ends at a place left the head within some interval of
  /// depression; all of it counts.
  bool intersects(const Sphere& sphere) const;

 private:
  bool straight_paths_intersect(const frames::Vec3& direction, double around_sine) const;
  bool refracted_paths_intersect(const frames::Vec3& to_centre_m, double distance_m, double radius_m) const;

  Frustum frustum_;
  bool straight_;
  double low_rad_, high_rad_;  // from the plane across the axis
  frames::Vec3 middle_enu_;    // across the axis, in the middle of the angles about it ...
  double half_rad_;            // ... which go so far to either side
  double half_cosine_, half_sine_;
};

inline bool intersects(const Frustum& frustum, const Sphere& sphere) {
  return PreparedFrustum(frustum).intersects(sphere);
}

}  // namespace ensonify::lod
