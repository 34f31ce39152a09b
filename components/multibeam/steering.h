#pragma once

#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include "components/multibeam/config.h"
#include "kernels/acoustics/array/beam_layout.h"
#include "kernels/base/frames/attitude.h"

namespace ensonify {

/// Sensor values that the head has when it transmits, errors and latency included.
struct SteeringInputs {
  double sound_speed_mps = 1500.0;          // at the face
  std::optional<frames::Attitude> vehicle;  // by the motion sensor; nothing: nothing can be stabilised
  double mean_heading_rad = 0.0;            // of the vehicle: what yaw is held against
};

/// Transmission of a sector. Sines are from the planes across the head's x axis (transmit) and its y axis.
struct SteeredSector {
  double sin_transmit = 0.0;  // of its fan
  double middle_rad = 0.0;    // of its fan, about the head's x axis from its z axis, positive to starboard
  double lower_sine = -std::numeric_limits<double>::infinity();  // edges; infinite at the edges of the swath
  double upper_sine = std::numeric_limits<double>::infinity();
  int first_beam = 0;  // that receive it
  int beams = 0;
};

/// Steering of the arrays in one ping.
struct Steering {
  double sound_speed_mps = 1500.0;  // delays are made for it
  std::vector<SteeredSector> sectors;
  std::vector<float> sin_beams;
  std::vector<float> beam_angle_rad;      // their arcsines
  std::vector<std::uint8_t> beam_sector;  // index in sectors
  std::vector<float> sin_soundings;       // where soundings are sought: the beams, or more of high density ...
  std::vector<float> sounding_angle_rad;  // ... their arcsines ...
  std::vector<float> across_rad;          // ... and from the vertical, when roll is stabilised
  std::vector<int> beam_of_sounding;      // ascending
  bool roll_stabilised = false;
  bool pitch_stabilised = false;
  bool yaw_stabilised = false;

  bool high_density() const { return sin_soundings.size() > sin_beams.size(); }
};

/// Which part of a swath each sector has: angles from the vertical when roll is stabilised.
std::vector<array::TransmitSector> sectors_of(const MultibeamConfig& config, double swath_rad);

/// The fan of each sector goes through the middle of its part of the swath, and the beams cut it at their angles from
/// the vertical below the head, as far as roll, pitch and yaw are stabilised; else from the head's z axis. All stay as
/// they are for the whole ping. A beam that would have to point behind the face lies along it.
Steering steer(const MultibeamConfig& config, double swath_rad, const SteeringInputs& inputs);

/// The heading about which a vehicle yaws: a running mean with a time constant, that of the first measurement to begin
/// with. A steady turn lags it by rate times time constant.
class HeadingMean {
 public:
  explicit HeadingMean(double time_constant_s) : time_constant_s_(time_constant_s) {}

  void update(double time_s, double heading_rad) {
    if (!begun_) mean_rad_ = heading_rad;
    const double share = begun_ ? 1.0 - std::exp(-(time_s - time_s_) / time_constant_s_) : 0.0;
    mean_rad_ += share * std::remainder(heading_rad - mean_rad_, 2.0 * std::numbers::pi);
    time_s_ = time_s;
    begun_ = true;
  }

  double mean_rad() const { return mean_rad_; }

 private:
  double time_constant_s_;
  double time_s_ = 0.0, mean_rad_ = 0.0;
  bool begun_ = false;
};

}  // namespace ensonify
