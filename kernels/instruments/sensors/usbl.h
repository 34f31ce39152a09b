#pragma once

#include <cstdint>
#include <optional>

#include "kernels/base/frames/attitude.h"
#include "kernels/base/random/stream.h"

namespace ensonify::sensors {

/// An ultra-short baseline system: a small array finds direction and two-way time of a transponder's answer.
struct UsblErrors {
  double range_white_m = 0.05;
  double sound_speed_scale = 0.0;    // relative error of the speed by which time becomes range, as it is
  double bearing_white_rad = 0.002;  // standard deviation of each of two small angles, on the array's axis
  double longest_m = 1000.0;
  double widest_rad = 1.3;             // from the array's axis (its down): beyond, no answer
  double outlier = 0.0;                // probability that a reflection is taken for the answer
  double speed_of_sound_mps = 1500.0;  // mean over the path, for the age of the fix
};

struct UsblReading {
  frames::Vec3 place_array_m;  // of the transponder, in the array's frame (forward, starboard, down)
  frames::Vec3 sigma_array_m;  // as stated: range and angles, along the array's axes
  double age_s;                // since the transponder was where the reading says
};

/// Angle between the array's axis and a place in its frame, 0 .. pi.
double off_axis_rad(const frames::Vec3& place_array_m);

/// Interrogation n: where the transponder seems to be, from where it is. Angles get worse away from the array's axis as
/// 1 / cos, as those of any flat array. Empty: no answer.
std::optional<UsblReading> locate(const UsblErrors& errors, const frames::Vec3& true_array_m,
                                  const random::Stream& stream, std::uint64_t n);

}  // namespace ensonify::sensors
