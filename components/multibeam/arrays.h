#pragma once

#include <Eigen/Core>

#include "components/multibeam/config.h"
#include "components/multibeam/steering.h"
#include "kernels/acoustics/array/line_array.h"
#include "kernels/acoustics/array/pattern_table.h"

namespace ensonify {

/// The receive line of a head, as it is and as its processing knows it.
struct ReceiveLine {
  double wavelength_m = 0.005;  // that it was designed for
  array::LineArray whole;
  array::SplitAperture halves;  // positive: starboard
};

/// With side lobes switched off they lie 60 dB down, and the main lobe is wider for it; the elements are the same.
ReceiveLine receive_line(const MultibeamConfig& config);

/// The transmit line. Both lines are as long as their shading asks for, to have the beam widths that are configured at
/// the head's frequency.
array::LineArray transmit_line(const MultibeamConfig& config);
/// First null of the transmit line, as a sine, at a frequency.
double transmit_null(const MultibeamConfig& config, double frequency_hz);

/// Lengths, in wavelengths at a frequency, of the uniform lines that would have the same widths at -3 dB ...
double transmit_length_in_waves(const MultibeamConfig& config, double frequency_hz);
double receive_length_in_waves(const MultibeamConfig& config, double frequency_hz);

/// ... and of those that would see the same area.
struct AreaLengths {
  double transmit_in_waves = 0.0, receive_in_waves = 0.0;
};
AreaLengths area_lengths(const MultibeamConfig& config, double frequency_hz);

/// Pattern of a sector's transmission, in the head's frame: the transmit line's beam along x; across-track everywhere
/// or between the sector's edges; less behind the face.
class SectorPattern {
 public:
  /// Sine over which an edge falls, from full to nothing; half way it is at -6 dB.
  static constexpr double kRollOff = 0.1;

  SectorPattern(const MultibeamConfig& config, double frequency_hz);

  /// From now on; sines and edges are those of the water as it is.
  void steer(const SteeredSector& sector) { sector_ = sector; }

  /// Power, 1 on the axis.
  float transmitted_power(const Eigen::Vector3f& direction_head) const;
  /// Amplitude that an element of the receive line gives a direction.
  float element_amplitude(const Eigen::Vector3f& direction_head) const {
    return direction_head.z() < 0.0F ? behind_ : 1.0F;
  }
  /// Power of isotropic noise in an element, over that of one that receives all around.
  double noise_share() const { return 0.5 * (1.0 + static_cast<double>(behind_) * static_cast<double>(behind_)); }

 private:
  float edge(double sine_inside) const;

  array::PatternTable line_, edge_;
  double first_null_;  // beyond it there is nothing, where side lobes are switched off
  float behind_;
  SteeredSector sector_;
};

}  // namespace ensonify
