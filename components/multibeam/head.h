#pragma once

#include <deque>
#include <memory>
#include <vector>

#include "components/multibeam/arrays.h"
#include "components/multibeam/config.h"
#include "components/multibeam/sector_echoes.h"
#include "components/multibeam/steering.h"
#include "components/sonar/ping_event.h"
#include "components/sonar/trace_summary.h"
#include "kernels/acoustics/detect/bottom.h"
#include "kernels/acoustics/trace/scene.h"
#include "kernels/base/frames/pose.h"
#include "messages/sonar.h"

namespace ensonify {

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
                      const frames::PoseHistory& truth, trace::Scene& seabed, Ping& ping);

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
