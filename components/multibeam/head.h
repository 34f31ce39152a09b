#pragma once

#include <deque>
#include <memory>
#include <span>
#include <vector>

#include "components/multibeam/arrays.h"
#include "components/multibeam/config.h"
#include "components/multibeam/steering.h"
#include "components/sonar/array_echoes.h"
#include "components/sonar/sea_acoustics.h"
#include "kernels/acoustics/detect/bottom.h"
#include "kernels/acoustics/trace/scene.h"
#include "kernels/base/frames/pose.h"
#include "messages/sonar.h"

namespace ensonify {

/// The acoustics of one transmit sector: what its beams receive of its transmission. Uses the true motion, the actual
/// mounting and the true water, as the sea does. Of other sectors it receives what its filter lets through, by its own
/// beams' side lobes and where sectors join.
class SectorEchoes {
 public:
  /// The design must outlive the sector.
  SectorEchoes(const MultibeamConfig& config, const ArrayDesign& design, std::size_t sector,
               std::shared_ptr<const Environment> environment);
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
    array::Pattern transmit;
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
            const frames::PoseHistory& truth, const trace::Scene& seabed, Memory& memory) const;
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

/// The acoustics of a Mills-cross head: what its beams receive. What the instrument makes of it is in soundings.h.
class MultibeamHead {
 public:
  explicit MultibeamHead(const MultibeamConfig& config);
  MultibeamHead(const MultibeamHead&) = delete;
  MultibeamHead& operator=(const MultibeamHead&) = delete;

  /// Beams of one sector against time after that sector's transmission, as all of the receive line and as each half of
  /// it receives them: before gain and converter.
  /// A point's echo counts as a rectangle of its energy, echo_s long about its middle. The times of the image's samples
  /// are such that this rectangle begins at the point's arrival. The middle comes middle_s after it: half a tone's
  /// length, 0 of a chirp, whose peak stands there.
  struct Received {
    detect::Amplitudes image;
    detect::HalfApertures halves;
    double echo_s = 0.0, middle_s = 0.0;
  };
  /// A ping as received, in memory of the caller, which may be used again.
  struct Ping {
    std::vector<Received> sectors;                      // their spans lie in this ping
    TraceSummary trace;                                 // of all sectors
    std::shared_ptr<std::vector<float>> amplitude_upa;  // of all beams; a new one while messages still hold the last
    // Scratch.
    std::vector<SectorEchoes::Memory> memory;
    std::vector<SectorEchoes::Sent> sent;
    std::vector<float> part;  // amplitudes of a sector
  };
  /// Fills a ping: a function of shot, settings, steering, poses and tiles. `truth` has a pose.
  void receive_echoes(const PingEvent& event, const HeadSettings& settings, const Steering& steering,
                      const frames::PoseHistory& truth, const trace::Scene& seabed, Ping& ping);

  /// A ping as a message, without a track; amplitudes without a converter are shared with it. The phase costs time and
  /// is left out unless asked for, or without speckle, when there is none.
  msg::Ping ping_message(const Ping& received, const PingEvent& event, const HeadSettings& settings,
                         const Steering& steering, bool phase) const;
  /// The settings that a ping was made with.
  msg::AppliedSettings applied(const PingEvent& event, const HeadSettings& settings, const Steering& steering) const;
  std::size_t max_ping_bytes() const;
  const ArrayDesign& design() const { return design_; }

 private:
  MultibeamConfig config_;
  ArrayDesign design_;
  std::deque<SectorEchoes> sectors_;
  std::vector<SectorEchoes::PingDesign> designs_;  // by sector, of the settings of the newest ping
};

}  // namespace ensonify
