#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "kernels/base/frames/attitude.h"

/// Uncertainty of a sounding: what each source of error is stated to err by, propagated to its place
/// [HareGodinMayer1995].
namespace ensonify::uncertainty {

using Matrix3 = Eigen::Matrix3d;
using frames::Vec3;

/// Standard deviations of what goes into every sounding besides navigation and detection. Zero: does not err.
struct Sources {
  // Heights, for what the navigation's own height has not in it.
  double heave_m = 0.0;
  double draught_m = 0.0;  // static, with loading
  double squat_m = 0.0;    // and settlement
  double tide_m = 0.0;     // and datum
  // Sound speed.
  double cast_mps = 0.0;  // all of the applied profile
  double face_mps = 0.0;  // of the speed that beams are steered with
  // Installation.
  std::array<double, 3> lever_arm_m{};  // forward, starboard, down
  double roll_rad = 0.0;                // of the mounting, from a patch test
  double pitch_rad = 0.0;
  double yaw_rad = 0.0;
  double position_latency_s = 0.0;  // of east and north
  double attitude_latency_s = 0.0;  // of attitude and heave
  // Beams.
  double along_rad = 0.0;  // from the plane of the transmit beam to where the echo came from

  bool operator==(const Sources&) const = default;
};

/// Errors stated by navigation: covariances, of the rotation as a small turn about east, north, up.
struct Navigation {
  Matrix3 position_enu_m2 = Matrix3::Zero();
  Matrix3 rotation_enu_rad2 = Matrix3::Zero();
};

/// Errors stated by detection. The first two are errors of the range along the beam
/// (kernels/acoustics/detect/bottom.h).
struct Detected {
  double range_sd_m = 0.0;
  double angle_sd_rad = 0.0;
  double relief_sd_m = 0.0;  // height at the point less its mean over the footprint (relief.h)
};

/// Place of the sounding as seen from its head, and the head's motion.
struct Geometry {
  Vec3 away_enu_m = {0.0, 0.0, -1.0};  // from the head to the sounding; not zero
  Vec3 lever_enu_m = Vec3::Zero();     // from the navigation's reference point to the head
  frames::Quaternion enu_from_head = frames::enu_from_ned();
  Vec3 velocity_enu_mps = Vec3::Zero();
  Vec3 rate_enu_radps = Vec3::Zero();  // of turning
  double sound_speed_mps = 1500.0;     // in which the sounding was placed, about
};

/// Covariance of the sounding's place, m^2, east, north, up: sources taken as independent of each other, their effects
/// as linear. With d the depth below the head, t its angle from the vertical and c the sound speed:
/// what a footprint hides (relief) makes the echo on the beam's axis early or late: a height, and tan(t) of it outward;
/// attitude and lever arm turn and shift head and sounding as one; a mounting turns the sounding about the head's axes;
/// a latency takes it on with the velocity or the turning; a cast that is wrong by dc all the way makes ranges wrong by
/// dc/c and bends rays by tan(t) dc/c, together d (1 - tan^2 t) dc/c in height; a face speed that is wrong by dc turns
/// beams by (tan a - tan t) dc/c, a being the angle off the array's normal: nothing on a level array, whose refraction
/// undoes it. Angles beyond kSteepest_rad from the vertical or the normal count as that.
Matrix3 covariance_enu_m2(const Geometry& geometry, const Detected& detected, const Navigation& navigation,
                          const Sources& sources);
inline constexpr double kSteepest_rad = 80.0 * 3.14159265358979323846 / 180.0;

/// 95 % of the vertical errors are within this: 1.96 standard deviations [S44].
double tvu_m(const Matrix3& covariance_enu_m2);

/// 95 % of the horizontal errors are within this radius: 2.45 standard deviations of an axis where both err alike
/// [S44], 1.96 where one errs alone; between them by the gamma distribution of the same mean and variance as the
/// squared distance, within 1 %.
double thu_m(const Matrix3& covariance_enu_m2);

/// One sounding of a ping's profile across the track. A sounding gives the mean height over its footprint, not that of
/// the point that it claims; how far the two differ is judged by the soundings' own profile.
struct ProfilePoint {
  double across_m = 0.0;     // level, any zero
  double height_m = 0.0;     // up
  double footprint_m = 0.0;  // half-power width of its beam on the seabed, > 0
  double noise_sd_m = 0.0;   // of the height, independent of its neighbours'
};

/// Squares of the fourth differences of the profile over one and two footprints to either side (joined by straight
/// lines), less what the noise adds to their mean, so that single values may be below 0. Slopes have none, and a flank
/// that is long against the footprint has little. NaN where the profile does not reach so far. `profile` ascends in
/// across_m; a point that does not is NaN and no neighbour.
std::vector<double> squared_bends_m2(std::span<const ProfilePoint> profile);

/// Variance of (mean height over a footprint less height at its middle) over that of the fourth difference of such
/// means, one footprint apart, on a seabed whose heights r apart differ by a variance proportional to r^(2 hurst),
/// 0 < hurst < 1, in any direction. It does not depend on how rough the seabed is. `aspect`: the footprint's width
/// along the track over that across, >= 0. Both ways it weighs as a beam's power over 1.5 half-power widths.
double unresolved_share(double hurst, double aspect);

}  // namespace ensonify::uncertainty
