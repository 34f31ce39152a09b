#pragma once

#include "kernels/base/frames/pose.h"

/// A survey's files as the instruments of the vessel would write them: of the navigation estimate, the measured
/// mounting, the applied settings and profile. Never of the truth.
namespace ensonify::logger {

/// What a file says of its vessel. The reference point is the vehicle's; the motion sensor and the antenna, as the
/// estimate is referred to them, stand there.
struct Vessel {
  frames::Mounting head;      // measured
  double water_line_m = 0.0;  // z of the water line at rest from the reference point, positive down
  bool dives = false;         // then it has no water line

  /// Where transmitter and receiver are installed. Readers of model 2040 add the phase centres of its arrays; the sum
  /// is the head's origin.
  frames::Vec3 transmitter_body_m() const;
  frames::Vec3 receiver_body_m() const;

  /// The body's pose, from that of its head.
  frames::Pose body_pose(const frames::HeadPose& head_pose) const;
  /// Origin of the x and y of soundings, and the position of 'P': at the water line, tilted with the vessel.
  frames::Vec3 horizontal_origin_enu_m(const frames::Pose& body) const;
  /// Of the head below the water line, by the measured heave (positive down, at the reference point).
  double transducer_depth_m(const frames::Pose& body, double heave_down_m) const;
};

}  // namespace ensonify::logger
