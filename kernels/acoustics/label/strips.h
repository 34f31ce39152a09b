#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "kernels/acoustics/trace/contributors.h"
#include "kernels/acoustics/trace/ray.h"

namespace ensonify::label {

/// Directions about an axis of the head: the sine along it, and the angle about it from `zero` towards `quarter`.
struct Axes {
  Eigen::Vector3f axis = Eigen::Vector3f::UnitY();
  Eigen::Vector3f zero = Eigen::Vector3f::UnitX();
  Eigen::Vector3f quarter = Eigen::Vector3f::UnitZ();

  Eigen::Vector3f direction(double sine, double angle_rad) const;
  double angle_rad(const Eigen::Vector3f& direction) const {
    return static_cast<double>(std::atan2(direction.dot(quarter), direction.dot(zero)));
  }
};

/// Directions of one sine, on a cone about the axis. In sine and angle the element of solid angle is their product.
struct Strip {
  double sine = 0.0, width = 0.0;  // the width in sine
  double counted = 0.0;  // of it, where strips have a width between them: what a row could receive is counted once
  double first_rad = 0.0, last_rad = 0.0;  // about the axis
  int sector = 0;                          // rows of the image that it belongs to
  int steps = 64;                          // even ones, to start with
};

/// What one ray hits first, and what comes back of it.
struct RayEcho {
  std::uint32_t contributor = trace::kNoise;  // by the direct path; kNoise: nothing is hit
  float time_s = 0.0F;                        // two-way, after transmission
  float sine = 0.0F;                          // along the axis, of its arrival at the receiver
  float level_upa2 = 0.0F;                    // mean square of a steradian of such rays

  bool hit() const { return contributor != trace::kNoise; }
};

/// A ray of a strip: what it hits first, and the seabed, through all bodies.
struct Point {
  double angle_rad = 0.0;
  RayEcho first, seabed;
};

/// Traces rays and their echoes, one for each; through_bodies: to what is behind all of them.
using TraceEchoes = std::function<void(const trace::Rays& rays, bool through_bodies, std::vector<RayEcho>& echoes)>;

/// How finely neighbours of a strip are halved.
struct Fineness {
  double body_s = 1e-5;    // two-way time between neighbours on one body
  double seabed_s = 1e-4;  // and on the seabed
  int halvings = 8;        // at most, of the first steps; where one body ends and another begins all of them
};

/// The rays of each strip in the order of their angles. Where neighbours lie too far apart in time, or one is on a body
/// on which the other is not, one between them is traced, and so on. What is farther apart after that is not one
/// surface. The same bits for any number of threads.
void trace_strips(const Axes& axes, std::span<const Strip> strips, const Fineness& fineness, const TraceEchoes& trace,
                  std::vector<std::vector<Point>>& points);

/// Whether neighbours are on one surface: not farther apart than a few times what they were halved to.
inline bool adjoin(const RayEcho& a, const RayEcho& b, double fine_s) {
  constexpr float kFew = 2.0F;
  return a.hit() && b.hit() && std::abs(a.time_s - b.time_s) <= kFew * static_cast<float>(fine_s);
}

}  // namespace ensonify::label
