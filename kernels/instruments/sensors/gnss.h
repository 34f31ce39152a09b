#pragma once

#include <cstdint>
#include <optional>

#include "kernels/base/frames/attitude.h"
#include "kernels/base/random/stream.h"

namespace ensonify::sensors {

/// Quality of a fix, with the numbers of NMEA's GGA sentence [NMEA0183].
enum class FixQuality : int { kNone = 0, kSingle = 1, kDifferential = 2, kRtkFixed = 4, kRtkFloat = 5 };

/// Errors of one quality of position: standard deviations at a dilution of precision of 1.
struct FixErrors {
  double horizontal_m = 0.0;         // white, each of east and north
  double vertical_m = 0.0;           // white
  double wander_horizontal_m = 0.0;  // slow: atmosphere, orbits, multipath; Gauss-Markov
  double wander_vertical_m = 0.0;
};

struct GnssErrors {
  FixQuality best = FixQuality::kRtkFixed;
  FixErrors fix;       // at its best
  FixErrors degraded;  // from the first fix until it is at its best
  FixQuality while_degraded = FixQuality::kRtkFloat;
  double wander_s = 300.0;       // > 0, correlation time of the slow errors
  double first_fix_s = 5.0;      // from the antenna's coming up to a fix
  double converge_s = 20.0;      // from a fix to the best
  double hdop = 1.0;             // mean dilution; errors are multiplied by it
  double hdop_wander = 0.0;      // how much it changes, relative, over `hdop_wander_s`
  double hdop_wander_s = 900.0;  // satellites come and go
  double washed_depth_m = 0.0;   // an antenna lower than this above the water is under it
};

struct GnssReading {
  FixQuality quality = FixQuality::kNone;  // kNone: the rest means nothing
  double hdop = 0.0;
  frames::Vec3 error_enu_m = frames::Vec3::Zero();  // measured less true place of the antenna
  frames::Vec3 sigma_enu_m = frames::Vec3::Zero();  // as the receiver states it: white and slow errors together
};

/// A satellite positioning receiver. Under water and during outages there is no fix; afterwards it takes time to find
/// one, and time to make a good one of it. Satellites are not simulated: dilution of precision is a number that
/// wanders.
class Gnss {
 public:
  Gnss(const GnssErrors& errors, const random::Stream& stream);

  /// The reading dt after the one before it. `antenna_above_water_m` < washed_depth_m, or `jammed`: nothing is
  /// received.
  GnssReading measure(double antenna_above_water_m, bool jammed, double dt_s);

 private:
  GnssErrors errors_;
  random::Stream stream_;
  random::GaussMarkov east_, north_, up_, dilution_;  // of sigma 1
  double received_s_;                                 // how long satellites have been in view
  std::uint64_t n_ = 0;
};

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
