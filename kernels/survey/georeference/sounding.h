#pragma once

#include "kernels/base/frames/attitude.h"
#include "kernels/water/refraction/profile.h"

/// Placing of soundings by an instrument: from beam angle, travel time, the sound speed at its face and the cast
/// that it applies. Directions and places are in the level frame: FRD with roll and pitch taken out, as the instrument
/// assumes them.
namespace ensonify::georeference {

/// The downward unit vector whose sine from the plane across `transmit_axis` is sin_transmit, and across `receive_axis`
/// sin_receive: where the cones of a Mills cross intersect. Axes are unit vectors in any one frame, and so is `down`,
/// which chooses between the two intersections. cones that do not intersect give the direction between them in the
/// plane of the axes. Throws std::invalid_argument for parallel axes.
frames::Vec3 intersect_cones(const frames::Vec3& transmit_axis, double sin_transmit, const frames::Vec3& receive_axis,
                             double sin_receive, const frames::Vec3& down);

/// Instrument's data of a sounding.
struct MeasuredSounding {
  frames::Vec3 direction_level = {0.0, 0.0, 1.0};  // of the beam at the face, unit length
  double two_way_s = 0.0;
  double face_depth_m = 0.0;       // below the water surface, where the cast counts from
  double face_speed_mps = 1500.0;  // used to steer the beam; the cast's own at that depth traces from the cast
};

/// Forward, starboard and down from the head, m: the ray's place after half the two-way time. It leaves the face at the
/// beam's depression with the face's speed, so cos(depression) / face speed is its Snell invariant in the applied
/// profile. A flat level array that steers with a wrong speed has the wrong angle and the wrong speed cancel; a rolled
/// one has not (docs/physics/acoustics/detection.md). A ray that the applied water would not let in (invariant times
/// its speed above 1) goes horizontally. One place for transmission and reception: sound out and back on the same path.
frames::Vec3 place_sounding(const MeasuredSounding& measured, const refraction::SoundSpeedProfile& applied);

}  // namespace ensonify::georeference
