#pragma once

#include <memory>
#include <vector>

#include "components/multibeam/config.h"
#include "components/multibeam/steering.h"
#include "kernels/acoustics/array/line.h"
#include "kernels/acoustics/array/pattern.h"

namespace ensonify {

/// The receive line of a head, as it is and as its processing knows it.
struct ReceiveLine {
  double wavelength_m = 0.005;  // that it was designed for
  array::LineArray whole;
  array::SplitAperture halves;  // positive: starboard
};

/// Lengths, in wavelengths, of the uniform lines that would see the same area.
struct AreaLengths {
  double transmit_in_waves = 0.0, receive_in_waves = 0.0;
};

/// Both lines at the frequency of a sector.
struct SectorDesign {
  double frequency_hz, delay_s, wavelength_m;
  double transmit_in_waves, receive_in_waves;  // of the uniform lines that would have the same widths at -3 dB
  AreaLengths area;
  double transmit_null;           // sine
  double phase_centres_in_waves;  // from half to half of the receive line
  std::shared_ptr<const array::PatternTable> transmit;
};

/// The arrays of a head, designed once. Both lines are as long as their shading asks for, to have the beam widths that
/// are configured at the head's frequency. With side lobes switched off those of the receive line lie 60 dB down, and
/// the main lobe is wider for it; the elements are the same.
struct ArrayDesign {
  explicit ArrayDesign(const MultibeamConfig& config);

  array::LineArray transmit;
  ReceiveLine receive;
  AreaLengths area;  // at the head's frequency
  std::vector<SectorDesign> sectors;
  std::shared_ptr<const array::PatternTable> edge;  // of a sector at sine 0, whose inside lies at positive sines
};

/// Pattern of a sector's transmission, in the head's frame: the transmit line's beam along x; across-track everywhere
/// or between the sector's edges; less behind the face.
class SectorPattern {
 public:
  /// Sine over which an edge falls, from full to nothing; half way it is at -6 dB.
  static constexpr double kRollOff = 0.1;

  SectorPattern(const MultibeamConfig& config, const ArrayDesign& design, std::size_t sector);

  /// Makes it the pattern of the transmission of a sector steered by sines and edges of the water as it is.
  void steer(const SteeredSector& sector, array::Pattern& transmit) const;
  /// Of an element of the receive line.
  array::Pattern element() const;
  /// Power of isotropic noise in an element, over that of one that receives all around.
  double noise_share() const;

 private:
  std::shared_ptr<const array::PatternTable> line_, edge_;
  float end_;  // beyond this sine there is nothing, where side lobes are switched off
  array::FaceFactor face_;
};

}  // namespace ensonify
