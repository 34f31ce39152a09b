#pragma once

#include "kernels/base/frames/attitude.h"

/// Patch test: how a multibeam echo sounder is turned on its vehicle, and how late its navigation is, found from
/// soundings of the same seabed on several lines.
namespace ensonify::boresight {

using frames::Quaternion;
using frames::Vec3;

/// A sounding as the instrument placed it, and what it was placed by: the navigation estimate at transmission. All in
/// the world (ENU).
struct Sounding {
  double time_s = 0.0;
  Vec3 place_enu_m = Vec3::Zero();
  Vec3 head_enu_m = Vec3::Zero();  // the head at transmission
  Quaternion enu_from_body = frames::enu_from_ned();
  Vec3 velocity_enu_mps = Vec3::Zero();  // of the head
  Vec3 rate_enu_radps = Vec3::Zero();    // of the body's turning
};

/// Errors of the installation. Zero: none.
struct Offsets {
  double position_latency_s = 0.0;  // age of east and north at their stamp: the vehicle was further on by v times this
  double attitude_latency_s = 0.0;  // age of an attitude and of heave at their stamp
  double roll_rad = 0.0;            // actual minus measured mounting: starboard down,
  double pitch_rad = 0.0;           // bow up,
  double yaw_rad = 0.0;             // clockwise from above, as rotations about the vehicle's axes
};

/// Place of the sounding if the offsets are as given: moved on along the track and with heave, and turned about the
/// head as one piece, by the vehicle's turning during the latency and by yaw, pitch and roll of the mounting. The
/// head's own way when the mounting turns (lever arms) is not touched, nor is the ray bent anew: where sound is 10 m/s
/// faster 30 m below, 1 degree at a beam of 60 degrees so misplaces by 6 mm, 3.5 degrees by 22 mm (closed form of the
/// arc); after a large offset, survey again with the mounting corrected.
struct Placed {
  Vec3 place_enu_m;
  Eigen::Matrix<double, 3, 5>
      rates;  // m per s of the latencies, m per rad of roll, pitch, yaw: in the order of Offsets
};
Placed place(const Sounding& sounding, const Offsets& offsets);

}  // namespace ensonify::boresight
