#pragma once

#include <optional>

#include "kernels/base/frames/attitude.h"

/// From what an instrument assumes (attitude by its motion sensor, sound speed at the face by its probe) to the sines
/// that it steers its arrays to, and from those to where the beams then really are.
///
/// A Mills cross transmits with a line along the head's x axis (forward) and receives with one along y (starboard). A
/// line steered to sine s receives the cone x . d = s, or y . d = s. Nothing here knows the truth: the caller hands in
/// the attitude that the sensor has delivered by the time in question, errors and latency included.
namespace ensonify::array {

/// Which angles the beams are held against.
struct Stabilisation {
  bool pitch = true;  // transmit fan held vertical
  bool yaw = false;   // transmit fan held across the reference heading
  bool roll = true;   // beam angles and sector edges counted from the vertical
};

/// The frame in which beam angles are counted is level (x along the reference heading, y starboard, z down) as far as
/// its angles are stabilised, and turned with the head in the others. This is the rotation from the head into it.
///
/// head_measured: attitude of the head, i.e. frames::attitude_of(enu_from_body_measured * body_from_head_measured).
/// reference_heading_rad: what yaw is held against, e.g. the line's course or a slow mean of the heading.
frames::Quaternion held_from_head(const Stabilisation& stabilisation, const frames::Attitude& head_measured,
                                  double reference_heading_rad);

/// Direction at `across_rad` from the z axis towards starboard, tilted forward out of the y-z plane by `tilt_rad`
/// (counted on the cone about x): (sin t, cos t sin a, cos t cos a).
frames::Vec3 direction_held(double across_rad, double tilt_rad = 0.0);

/// Sine to steer the transmit line to, so that the fan of a sector passes through `direction` (in the held frame: the
/// sector's centre): x . d. A cone cannot follow a vertical plane with a pitched head away from that direction; several
/// sectors, each with a sine of its own, follow it better.
double transmit_sine(const frames::Quaternion& held_from_head, const frames::Vec3& direction);

/// Sine to steer the receive line, or an edge of a transmit sector, to `direction`: y . d, with the attitude at receive
/// time, or transmit time.
double across_sine(const frames::Quaternion& held_from_head, const frames::Vec3& direction);

/// The direction in the held frame at `across_rad` on the cone that the transmit line makes with the sine given: where
/// the sector's fan really is there. Nothing when the cone does not reach that angle.
std::optional<frames::Vec3> fan_direction(const frames::Quaternion& held_from_head, double sin_transmit,
                                          double across_rad);

/// Unit vector on both cones axis . d = sine, on the side of axis_transmit x axis_receive (below the head: x cross y is
/// z). Axes are unit vectors in one frame, at transmit and at receive time; they need not be orthogonal but must not be
/// parallel. Nothing when the cones do not intersect.
std::optional<frames::Vec3> cone_intersection(const frames::Vec3& axis_transmit, double sin_transmit,
                                              const frames::Vec3& axis_receive, double sin_receive);

/// Sine at which a beam really points that was steered to `sin_commanded` for the sound speed `used_mps` at the face
/// where it is `true_mps`: sin_commanded true / used. Beyond -1..1 there is no such beam.
double true_sine(double sin_commanded, double used_mps, double true_mps);

}  // namespace ensonify::array
