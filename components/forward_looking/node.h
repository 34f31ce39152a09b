#pragma once

#include "components/forward_looking/head.h"
#include "components/runtime/head/head_inputs.h"
#include "components/runtime/head/ping_cycle.h"
#include "components/runtime/ports.h"

namespace ensonify {

/// Two kinds of event: a transmission, at which the settings of the ping are fixed, and the end of its processing, at
/// which every pose it needs has arrived and its image is computed and published.
class ForwardLookingNode {
 public:
  using Config = ForwardLookingConfig;
  static constexpr const char* kComponent = "forward_looking";

  ForwardLookingNode(const Config& config, Ports& ports);

  SimTime step(SimTime now);

 private:
  void transmit(SimTime now);
  void publish(const PingUnderWay& ping);

  Config config_;
  ForwardLookingHead head_;
  HeadInputs inputs_;
  PingCycle cycle_;
  Ports::Out<msg::Ping> ping_out_;
};

}  // namespace ensonify
