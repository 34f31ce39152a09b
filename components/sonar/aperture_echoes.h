#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "components/sonar/sea_acoustics.h"
#include "components/sonar/shot_design.h"
#include "components/sonar/source_energy.h"
#include "kernels/acoustics/array/pattern.h"
#include "kernels/acoustics/echo/aperture.h"
#include "kernels/acoustics/echo/speckle_cells.h"
#include "kernels/acoustics/echo/volume.h"
#include "kernels/base/random/stream.h"

namespace ensonify {

/// Patterns of transducers of one frequency, the same of each in the same place.
struct AperturePatterns {
  std::vector<array::Pattern> transmit, receive;
};

/// Transducers of one frequency that send at once and of which each receives for itself: both sides of a sidescan, the
/// one face of an echosounder.
struct Apertures {
  double frequency_hz = 0.0;
  AperturePatterns patterns;
  double directivity_index_db = 0.0;                            // of each, against noise from all directions
  double electronic_noise_db = -200.0;                          // as sound in the water, dB re 1 uPa^2/Hz
  double narrowest_rad = 0.01;                                  // half-power width of the narrowest lobe
  Eigen::Vector3f narrow_axis_head = Eigen::Vector3f::UnitX();  // along which it is narrow
  double nearest_m = 10.0;       // range down to which patches of seabed must be finer than the lobe
  double resolution_m = 0.075;   // in range
  std::uint64_t seed = 1;        // of the scene
  std::uint64_t drawn_seed = 1;  // of speckle and noise
  std::string process;           // names the streams of random numbers, with the frequency
};

/// Reception of a shot by apertures.
struct ApertureReception {
  std::uint64_t ping = 0;
  echo::Sampling sampling;
  const echo::Arrivals& foreign;  // of other transmissions
};

/// What apertures receive of a transmission, by the true motion and the true water: seabed, surface, water column,
/// other transmissions and noise. The twin of ArrayEchoes.
class ApertureEchoes {
 public:
  ApertureEchoes(const Apertures& apertures, std::shared_ptr<const Environment> environment, const Effects& effects,
                 const Quality& quality);

  const SeaAcoustics& sea() const { return sea_; }
  std::span<const array::Pattern> transmit() const { return apertures_.patterns.transmit; }
  /// Patches of seabed that answer as one point.
  const echo::SpeckleCells& cells() const { return cells_; }

  /// Memory of the caller: the image lies in it until it is used again.
  struct Memory {
    echo::Image image;
    // Scratch.
    echo::Image coherent;
    std::vector<float> gain, coherent_gain, foreign_gain, volume_upa2;
    echo::TimeIndex index;
    echo::RowBackground background;
  };

  /// Mean square of noise and water column that is expected, aperture by sample. After beamform() with the same memory.
  std::vector<float> expected_background_upa2(const echo::Pulse& pulse, const echo::Sampling& sampling,
                                              const Memory& memory) const;
  std::span<const array::Pattern> receive() const { return apertures_.patterns.receive; }

  /// What each source sends, in the order of sources: without speckle only.
  std::vector<SourceEnergy> energies(const Shot& shot, const Echoed& echoed, const ShotDesign& design,
                                     const ApertureReception& reception, Memory& memory) const;

  /// Third stage of a shot: complex envelopes, aperture by sample, uPa rms. In memory.image.
  const echo::Image& beamform(const Shot& shot, const Echoed& echoed, const ShotDesign& design,
                              const ApertureReception& reception, Memory& memory) const;

 private:
  echo::EchoSet weighed(const echo::Arrivals& arrivals, const echo::PairedArrivals& paired,
                        const frames::HeadPose& pose, std::vector<float>& gain) const;
  echo::EchoSet weighed_coherent(const Shot& shot, const Echoed& echoed, std::vector<float>& gain) const;
  static void form_mean_squares(std::span<const echo::EchoSet> echoes, std::span<const echo::EchoSet> coherent,
                                int rows, const ShotDesign& design, const echo::Sampling& sampling, Memory& memory);
  double noise_db(const echo::Pulse& pulse) const;

  Apertures apertures_;
  Effects effects_;
  random::Stream noise_, volume_;
  SeaAcoustics sea_;
  echo::SpeckleCells cells_;
  std::vector<echo::VolumeDirections> volume_directions_;  // by aperture; empty: the water does not scatter
};

}  // namespace ensonify
