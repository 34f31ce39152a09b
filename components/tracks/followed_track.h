#pragma once

#include <optional>
#include <string>
#include <vector>

#include "components/tracks/track.h"
#include "kernels/base/frames/pose.h"
#include "kernels/vehicle/motion/gapped_curve.h"
#include "kernels/vehicle/motion/sampled_curve.h"
#include "scenarios/world/mission.h"

namespace ensonify::tracks {

/// A recorded track as a mission follows it: in the world, in sim time, on curves through the samples
/// (kernels/vehicle/motion/sampled_curve.h).
class FollowedTrack {
 public:
  /// What heights of moving() count from.
  enum class Height {
    kWaterLevel,  // the heave that is recorded, about the mission's depth, or the water line of what floats
    kDepth,       // less the depth that is recorded
    kDatum,       // chart datum
  };

  /// `origin`: of the world, where it has one of its own. Throws UserError with the file, the cause and what is allowed
  /// where the part that is asked for cannot be followed: gaps, places far from the site, speeds beyond `fastest_mps`.
  FollowedTrack(const Track& track, const FollowTrack& wanted, const std::optional<frames::Geodetic>& origin,
                double fastest_mps);

  /// Sim time of the last place; the first is at 0.
  double end_s() const { return end_s_; }
  /// The motion of the vehicle's reference point. Its height counts as height() says. At the end it stops.
  frames::MovingPose at(double t_s) const;
  Height height() const { return height_; }
  /// Roll, pitch and heave are the file's.
  bool attitude_is_recorded() const { return attitude_is_recorded_; }

 private:
  using Moving = motion::Moving;

  void place(const Track& track, const std::optional<frames::Geodetic>& origin, double fastest_mps);
  void take_heading(const Track& track);
  void head_along_the_way();
  void take(const std::vector<Value>& values, const char* what, motion::GappedCurve& curve) const;
  void check_gap(double from_s, double to_s, const char* what) const;
  double run_s(std::int64_t ns) const { return 1e-9 * static_cast<double>(ns - zero_ns_); }
  /// Of the file, for messages: from its first place on.
  double file_s(double t_s) const { return t_s + wanted_.from_s; }

  std::string file_;
  FollowTrack wanted_;
  std::int64_t zero_ns_ = 0;
  double end_s_ = 0.0;
  Height height_ = Height::kWaterLevel;
  bool attitude_is_recorded_ = false;
  std::optional<frames::LocalProjection> world_;  // only of a geodetic track
  std::vector<double> times_s_;                   // of places
  motion::SampledCurve east_m_, north_m_;
  motion::GappedCurve heading_rad_, roll_rad_, pitch_rad_, height_m_;
};

/// The track that a mission follows. Throws UserError, as reading and following do.
FollowedTrack followed_track(const FollowTrack& wanted, const std::optional<frames::Geodetic>& origin,
                             double fastest_mps);

}  // namespace ensonify::tracks
