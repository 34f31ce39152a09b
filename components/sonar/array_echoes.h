#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "components/sonar/sea_acoustics.h"
#include "components/sonar/shot_design.h"
#include "components/sonar/source_energy.h"
#include "kernels/acoustics/array/pattern.h"
#include "kernels/acoustics/echo/line_receiver.h"
#include "kernels/acoustics/echo/pulse.h"
#include "kernels/acoustics/echo/volume.h"
#include "kernels/acoustics/label/image.h"
#include "kernels/acoustics/trace/ray_distribution.h"
#include "kernels/base/random/stream.h"

namespace ensonify {

/// Side of the patches of seabed that answer as one point, from what it is at preview or below. A patch has about as
/// many rays whatever the quality: with fewer, the next ping would not find it again. At most four times finer, which
/// misplaces nothing that a head resolves.
inline double patch_m(double at_preview_m, double quality) {
  return at_preview_m * std::clamp(std::sqrt(trace::RaySettings::kPreview / quality), 0.25, 1.0);
}

/// A receive line of one frequency as its beams are made.
struct ReceiveArray {
  double frequency_hz = 0.0;
  echo::ElementLine elements;               // at the true speed of sound
  std::vector<std::vector<float>> weights;  // of the images that are wanted; the first is that of the whole line
  array::Pattern element;                   // of each
  double noise_share = 1.0;                 // isotropic noise that an element lets in, over what a point would
  double electronic_noise_db = -200.0;      // of each element, as sound in the water, dB re 1 uPa^2/Hz
  std::uint64_t seed = 1;
  std::string process,
      suffix;  // streams are PROCESS/noise, PROCESS/electronic and PROCESS/volume, each with the suffix
};

/// Reception of a shot by a line.
struct ArrayReception {
  std::uint64_t ping = 0;
  echo::Sampling sampling;
  std::span<const float> sin_beams;                // along the line, true
  std::span<const echo::VolumeDirections> volume;  // of ArrayEchoes::volume_directions; unused in clear water
  const echo::Arrivals& foreign;                   // of other transmissions
  std::span<float> amplitude_upa = {};             // as of echo::LineReceiver::Input
};

/// Echoes of one transmission as the beams of a line array receive them, by the true motion and the true water: seabed,
/// surface, water column, other transmissions, and noise at the elements. The twin of ApertureEchoes.
class ArrayEchoes {
 public:
  ArrayEchoes(const ReceiveArray& array, std::shared_ptr<const Environment> environment, const Effects& effects,
              const Quality& quality);

  const SeaAcoustics& sea() const { return sea_; }

  /// Directions in which the water column is received, of a transmission of this power; none where it does not scatter.
  std::vector<echo::VolumeDirections> volume_directions(
      const std::function<double(const Eigen::Vector3f& direction_head)>& transmitted, double step_rad) const;

  /// Images as memory of the caller, one per set of weights: beam by sample, complex envelopes, uPa rms. Without
  /// speckle they are roots of mean squares, whose phase says nothing.
  struct Memory {
    std::vector<echo::Image> images;
    // Scratch.
    std::vector<float> gain, coherent_gain, foreign_gain, volume_upa2;
    echo::LineReceiver::Memory receiver;
  };

  /// Mean square of noise and water column that is expected in the first image, beam by sample: of the water column
  /// what the beam's main lobe receives, by its power at sines off the axis. After beamform() with the same memory.
  std::vector<float> expected_background_upa2(const echo::Pulse& pulse, const ArrayReception& reception,
                                              const label::MainLobe& lobe, const Memory& memory) const;

  /// What each source sends to the first image, in the order of sources: without speckle only.
  std::vector<SourceEnergy> energies(const Shot& shot, const Echoed& echoed, const ShotDesign& design,
                                     const ArrayReception& reception, Memory& memory) const;

  /// Third stage of a shot: the images, in memory.images.
  std::span<const echo::Image> beamform(const Shot& shot, const Echoed& echoed, const ShotDesign& design,
                                        const ArrayReception& reception, Memory& memory) const;

 private:
  echo::EchoSet weighed(const Shot& shot, const echo::Arrivals& arrivals, const echo::PairedArrivals& paired,
                        std::vector<float>& gain) const;
  echo::EchoSet weighed_coherent(const Shot& shot, const Echoed& echoed, std::vector<float>& gain) const;
  SourceEnergy noise_energy(const echo::Background& noise, const ArrayReception& reception) const;
  SourceEnergy volume_energy(const echo::Background& noise, const ArrayReception& reception) const;
  echo::Background background(const Shot& shot, const Echoed& echoed, const echo::Pulse& pulse,
                              const ArrayReception& reception, std::vector<float>& volume_upa2) const;

  ReceiveArray array_;
  Effects effects_;
  SeaAcoustics sea_;
  random::Stream ambient_, electronic_, volume_;
  echo::LineReceiver receiver_;
  std::vector<echo::WantedImage> wanted_;
  std::optional<echo::SharedByBeams> shared_;  // without speckle
  std::optional<array::PatternTable> beam_;    // without speckle: a beam's amplitude by sine off its axis
};

}  // namespace ensonify
