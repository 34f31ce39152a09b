#pragma once

#include "components/echosounder/head.h"
#include "components/runtime/head/head_inputs.h"
#include "components/runtime/head/ping_cycle.h"
#include "components/runtime/ports.h"

namespace ensonify {

/// Two kinds of event: a transmission, at which the settings of the ping are fixed, and the end of its processing, at
/// which every pose it needs has arrived and it is computed and published.
class EchosounderNode {
 public:
  using Config = EchosounderConfig;
  static constexpr const char* kComponent = "echosounder";

  EchosounderNode(const Config& config, Ports& ports);

  SimTime step(SimTime now);

 private:
  void transmit(SimTime now);
  void publish(const PingUnderWay& ping);

  Config config_;
  EchosounderHead head_;
  HeadInputs inputs_;
  PingCycle cycle_;
  Ports::Out<msg::Ping> ping_out_;
  Ports::Out<msg::BottomTrack> bottom_out_;
};

}  // namespace ensonify
