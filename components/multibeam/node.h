#pragma once

#include <deque>
#include <optional>

#include "components/multibeam/arrays.h"
#include "components/multibeam/head.h"
#include "components/multibeam/heading_mean.h"
#include "components/multibeam/soundings.h"
#include "components/runtime/ports.h"
#include "components/sonar/auto_range.h"
#include "components/sonar/head_inputs.h"
#include "components/sonar/ping_cycle.h"
#include "messages/navigation.h"

namespace ensonify {

/// Two kinds of event: a transmission, at which the settings and the steering of the ping are fixed, and the end of its
/// processing, at which every pose it needs has arrived and it is computed and published.
class MultibeamNode {
 public:
  using Config = MultibeamConfig;
  static constexpr const char* kComponent = "multibeam";

  MultibeamNode(const Config& config, Ports& ports);

  SimTime step(SimTime now);

 private:
  void transmit(SimTime now);
  SteeringInputs steering_inputs(SimTime now) const;
  void publish(const PingUnderWay& ping);
  void publish_images(const HeadSettings& settings, const Steering& steering,
                      const std::vector<MultibeamHead::Received>& received, const msg::Soundings& soundings);
  void follow_range(const HeadSettings& settings);
  std::string trouble(const TraceSummary& trace_summary) const;

  Config config_;
  AreaLengths lines_;  // at the head's frequency
  MultibeamHead head_;
  refraction::SoundSpeedProfile applied_;
  SoundingMaker soundings_;
  HeadInputs inputs_;
  PingCycle cycle_;
  AutoRange range_;
  double swath_of_range_rad_;                 // that range_ knows
  std::optional<frames::Attitude> attitude_;  // the newest that the motion sensor given
  HeadingMean heading_;
  std::deque<Steering> steerings_;  // of the pings under way
  Ports::Out<msg::Ping> ping_out_;
  Ports::Out<msg::Soundings> soundings_out_;
  std::optional<Ports::Out<msg::Snippets>> snippets_out_;
  std::optional<Ports::Out<msg::SeabedImage>> image_out_;
};

}  // namespace ensonify
