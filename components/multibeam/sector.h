#pragma once

#include <memory>
#include <span>
#include <vector>

#include "components/multibeam/arrays.h"
#include "components/multibeam/config.h"
#include "components/multibeam/steering.h"
#include "components/sonar/array_echoes.h"
#include "components/sonar/surroundings.h"
#include "kernels/acoustics/detect/bottom.h"

namespace ensonify {

/// Beams of one sector against time after that sector's transmission, as all of the receive line and as each half of it
/// receives them: before gain and converter.
/// A point's echo counts as a rectangle of its energy, echo_s long about its middle. The times of the image's samples
/// are such that this rectangle begins at the point's arrival. The middle comes middle_s after it: half a tone's
/// length, 0 of a chirp, whose peak stands there.
struct SectorBeams {
  detect::Amplitudes image;
  detect::HalfApertures halves;
  double echo_s = 0.0, middle_s = 0.0;
};

/// The acoustics of one transmit sector: what its beams receive of its transmission. Uses the true motion, the actual
/// mounting and the true water, as the sea does. Of other sectors it receives what its filter lets through, by its own
/// beams' side lobes and where sectors join.
class Sector {
 public:
  /// Configuration and arrays outlive the sector; the environment is that of its frequency.
  Sector(const MultibeamConfig& config, const Effects& effects, const ArrayDesign& arrays, std::size_t number,
         std::shared_ptr<const Environment> environment);

  /// What follows from the settings of a ping.
  struct Design {
    double centre_rad;
    ShotDesign shot;
    std::vector<echo::VolumeDirections> volume_directions;  // empty: the water does not scatter
  };
  Design prepare(const HeadSettings& settings) const;

  /// Memory of a ping in one sector, the caller's: results lie in it until it is used again.
  struct Memory {
    /// Images of all of the receive line, of its starboard and of its port half (those without speckle alone: sums of
    /// mean squares have no phase). Times count from the sector's own transmission.
    ArrayEchoes::Memory beams;
    // Scratch.
    std::vector<frames::HeadPose> poses;  // from transmission on
    SteeredSector steered;                // in the water as it is
    array::Pattern transmit;
    ShotMemory shot;
    std::vector<float> sin_beams;
  };

  /// A sector's transmission.
  struct Sent {
    Shot shot;
    trace::Mesh mesh;
    Insonified insonified;
    echo::Sampling sampling;
    const Design& design;
  };

  /// First stage: rays from the true pose when it is sent. The design is that of the settings.
  Sent insonify(const PingEvent& event, const HeadSettings& settings, const Design& design, const Steering& steering,
                const Surroundings& around, Memory& memory) const;
  /// Second stage: echoes at the true poses at reception.
  Echoed echoes(const Sent& sent, Memory& memory) const;
  /// Third stage, when all sectors of the ping have sent: the beams of this one, with noise at the array's elements.
  /// Amplitudes, beam by sample, are written to `amplitude_upa`; the beams refer to it and to the memory.
  SectorBeams beamform(const PingEvent& event, const HeadSettings& settings, std::span<const Sent> sent,
                       std::span<const Echoed> echoed, std::span<float> amplitude_upa, Memory& memory) const;

  /// What each source sends to these beams, of a sector without speckle: in place of the third stage.
  std::vector<SourceEnergy> energies(const PingEvent& event, const HeadSettings& settings, std::span<const Sent> sent,
                                     std::span<const Echoed> echoed, std::span<const float> sin_beams,
                                     Memory& memory) const;

 private:
  const echo::Arrivals& foreign_echoes(const PingEvent& event, const HeadSettings& settings, std::span<const Sent> sent,
                                       std::span<const Echoed> echoed, Memory& memory) const;
  void aim(const Steering& steering, const frames::HeadPose& pose, Memory& memory) const;

  const MultibeamConfig& config_;
  const ArrayDesign& arrays_;
  std::size_t number_;
  SectorPattern pattern_;
  ArrayEchoes echoes_;
};

}  // namespace ensonify
