#pragma once

#include <optional>

#include "kernels/water/refraction/path.h"

/// Whole paths: to a depth, for a time, over a distance, and between two points.
namespace ensonify::refraction {

/// Totals of a whole path.
struct PathEnd {
  double horizontal_m = 0.0;
  double depth_m = 0.0;
  double depression_rad = 0.0;  // of the direction of travel at the end
  double travel_time_s = 0.0;
  double path_length_m = 0.0;
  double tube_m2 = 0.0;               // Path::tube_m2
  double horizontal_per_rad_m = 0.0;  // d(horizontal) / d(launch depression) at the end's depth; infinite at a turn
  int turns = 0;
  double turning_depth_m = 0.0;  // of the last turn, when there was one
};

/// From a depth, launched at a depression, to the first arrival at target_depth_m with at most max_turns turns. Empty
/// when there is none. A target at the source's own depth is reached by turning only.
/// Throws std::invalid_argument for depths that are not finite and depressions beyond the vertical (so do those below).
std::optional<PathEnd> path_to_depth(const SoundSpeedProfile& profile, double source_depth_m, double depression_rad,
                                     double target_depth_m, int max_turns = 0);

/// The same for a path that is already on its way. All but the turns is counted from its launch.
std::optional<PathEnd> path_to_depth(const Path& from, double target_depth_m, int max_turns = 0);

/// Point of the path after a time, however often it turns: what an instrument computes from a beam's angle at its face
/// and half the two-way time, with the profile that it applies.
PathEnd path_at_time(const SoundSpeedProfile& profile, double source_depth_m, double depression_rad, double time_s);

/// Point of the path at a horizontal distance. A vertical path has none: |depression| < pi/2.
PathEnd path_at_horizontal(const SoundSpeedProfile& profile, double source_depth_m, double depression_rad,
                           double horizontal_m);

/// The path between two points.
struct Eigenray {
  double launch_depression_rad = 0.0;
  PathEnd end;
};

/// The path from a depth to a point at a horizontal distance >= 0 and a depth, turning where it must; empty where none
/// goes: in the shadow beside a ridge of speed, where paths part. Where several
/// paths join the points (behind a caustic), one of them. Newton's method on the launch angle, kept inside a bracket
/// that halves when Newton fails; the path passes the point within 1 um or 1e-9 of the distance.
std::optional<Eigenray> eigenray(const SoundSpeedProfile& profile, double source_depth_m, double horizontal_m,
                                 double target_depth_m);

}  // namespace ensonify::refraction
