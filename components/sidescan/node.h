#pragma once

#include "components/sidescan/head.h"
#include "components/sonar/head_node.h"

namespace ensonify {

/// One channel of a sidescan: both sides and the bottom track of a ping.
class Sidescan {
 public:
  using Config = SidescanConfig;
  static constexpr const char* kComponent = "sidescan";

  static HeadPlan plan(const Config& config);

  Sidescan(const Config& config, std::size_t channel)
      : config_(config), channel_(config.channels[channel]), head_(config, channel_) {}

  HeadOutputs<msg::Ping, msg::BottomTrack> outputs() const { return {{"ping", head_.max_ping_bytes()}, {"bottom"}}; }
  SentPing transmit(SimTime now, const HeadSettings& settings, const HeadInputs& inputs) const;
  HeadReport<msg::Ping, msg::BottomTrack> ping(const PingEvent& event, const SentPing& sent, HeadInputs& inputs);

 private:
  Config config_;
  SidescanChannel channel_;
  SidescanHead head_;
};

using SidescanNode = HeadNode<Sidescan>;

}  // namespace ensonify
