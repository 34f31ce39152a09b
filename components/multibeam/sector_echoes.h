#pragma once

#include <span>
#include <vector>

#include "components/multibeam/arrays.h"
#include "components/multibeam/config.h"
#include "components/multibeam/steering.h"
#include "components/sonar/array_echoes.h"
#include "components/sonar/ping_event.h"
#include "kernels/base/frames/pose.h"

namespace ensonify {

/// The acoustics of one transmit sector: what its beams receive of its transmission. Uses the true motion, the actual
/// mounting and the true water, as the sea does. Of other sectors it receives what its filter lets through, by its own
/// beams' side lobes and where sectors join.
class SectorEchoes {
 public:
  /// The design must outlive the sector.
  SectorEchoes(const MultibeamConfig& config, const ArrayDesign& design, std::size_t sector);
  SectorEchoes(const SectorEchoes&) = delete;
  SectorEchoes& operator=(const SectorEchoes&) = delete;

  /// Memory of a ping in one sector, the caller's: results lie in it until it is used again.
  struct Memory {
    /// Images of all of the receive line, of its starboard and of its port half (those without speckle alone: sums of
    /// mean squares have no phase). Times count from the sector's own transmission.
    ArrayEchoes::Memory beams;
    // Scratch.
    std::vector<frames::HeadPose> poses;  // from transmission on
    SteeredSector steered;                // in the water as it is
    TransmittedPower power;
    ShotMemory shot;
    std::vector<float> sin_beams;
    echo::Arrivals foreign;
  };
  /// Design shared by pings of the same pulse and swath.
  struct PingDesign {
    double pulse_length_s, swath_rad;
    double centre_rad;  // of the sector
    ArrayPulse array;
    std::vector<echo::VolumeDirections> volume_directions;  // empty: the water does not scatter
  };
  PingDesign design_for(double pulse_length_s, double swath_rad) const;

  /// A sector's transmission and its echoes.
  struct Sent {
    Shot shot;
    Echoed echoed;
    echo::Sampling sampling;
    const PingDesign& design;
  };

  /// Transmission: rays from the true pose when it is sent, echoes at the true poses at reception. The design is that
  /// of the settings. `truth` has a pose.
  Sent send(const PingEvent& event, const HeadSettings& settings, const PingDesign& design, const Steering& steering,
            const frames::PoseHistory& truth, trace::Scene& seabed, Memory& memory) const;
  /// Beams of the sector, in memory.beams.images, when all sectors of the ping have sent; with noise at the array's
  /// elements. Both together are a function of the shot, the settings, the steering, the poses and the tiles.
  void beamform(const PingEvent& event, const HeadSettings& settings, std::span<const Sent> all, Memory& memory) const;

 private:
  void aim(const Steering& steering, const frames::HeadPose& pose, Memory& memory) const;

  MultibeamConfig config_;
  const ArrayDesign& arrays_;
  std::size_t sector_;
  SectorPattern pattern_;
  ArrayEchoes echoes_;
};

}  // namespace ensonify
