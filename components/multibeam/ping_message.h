#pragma once

#include <memory>
#include <span>
#include <vector>

#include "components/multibeam/config.h"
#include "components/multibeam/sector.h"
#include "components/multibeam/steering.h"
#include "messages/sonar.h"

namespace ensonify {

/// The settings that a ping was made with.
msg::AppliedSettings applied_settings(const MultibeamConfig& config, const PingEvent& event,
                                      const HeadSettings& settings, const Steering& steering);

/// Image of a ping: what its beams received, amplitudes of all sectors together and, where its phase is wanted, those
/// of each sector with their halves.
struct PingImage {
  std::shared_ptr<std::vector<float>> amplitude_upa;  // beam by sample
  std::span<const SectorBeams> sectors;
  bool phase = false;
};

/// A ping as a message, without a track; amplitudes without a converter are shared with it. The phase costs time.
/// Without speckle there is none.
msg::Ping ping_message(const MultibeamConfig& config, const PingEvent& event, const HeadSettings& settings,
                       const Steering& steering, const msg::AppliedSettings& applied, const PingImage& image);

}  // namespace ensonify
