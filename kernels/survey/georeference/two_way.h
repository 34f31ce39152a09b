#pragma once

#include "kernels/base/frames/pose.h"
#include "kernels/water/refraction/profile.h"

namespace ensonify::georeference {

/// Instrument's data of one echo: its estimated poses at transmission and at reception, the sines that it
/// steered its lines to (from the planes across the transmitter's x axis, and across the receiver's y axis), the speed
/// of sound that it steered with, and the two-way time. Heights of the poses count from the water surface.
struct MeasuredEcho {
  frames::HeadPose at_transmit;
  frames::HeadPose at_receive;
  double sin_transmit = 0.0;
  double sin_receive = 0.0;
  double face_speed_mps = 1500.0;
  double two_way_s = 0.0;
};

/// Origin of the echo in the water that the instrument assumes: along the direction in which both cones intersect
/// (intersect_cones), bent by the applied profile (place_sounding).
///
/// The head moves between transmission and reception. The ray is traced from half way between, and turned and shortened
/// by what a straight line to its end differs from there to the two places: exact in isovelocity water, else right to
/// the product of the shift over the range and the bending.
frames::Vec3 sounding_enu_m(const MeasuredEcho& measured, const refraction::SoundSpeedProfile& applied);

}  // namespace ensonify::georeference
