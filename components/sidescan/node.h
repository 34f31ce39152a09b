#pragma once

#include <vector>

#include "components/runtime/ports.h"
#include "components/sidescan/head.h"
#include "components/sonar/head_inputs.h"
#include "components/sonar/ping_cycle.h"
#include "messages/sonar.h"

namespace ensonify {

/// Two kinds of event: a transmission of all channels at once, at which the settings of the ping are fixed, and the end
/// of its processing, at which every pose it needs has arrived and it is computed and published.
class SidescanNode {
 public:
  using Config = SidescanConfig;
  static constexpr const char* kComponent = "sidescan";

  SidescanNode(const Config& config, Ports& ports);

  SimTime step(SimTime now);

 private:
  struct Channel {
    SidescanChannel config;
    SidescanHead head;
    Ports::Out<msg::Ping> ping_out;
    Ports::Out<msg::BottomTrack> bottom_out;
  };

  void transmit(SimTime now);
  void publish(const PingUnderWay& ping);

  Config config_;
  HeadInputs inputs_;
  PingCycle cycle_;
  std::vector<Channel> channels_;
};

}  // namespace ensonify
