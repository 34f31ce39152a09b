#pragma once

#include "components/runtime/head/head_inputs.h"
#include "components/runtime/head/ping_cycle.h"
#include "components/runtime/ports.h"
#include "components/scanning/head.h"

namespace ensonify {

/// Two kinds of event: a transmission, at which the settings of the ping are fixed, and the end of its processing, at
/// which every pose it needs has arrived and its row is computed and published. The transducer turns between pings.
class ScanningNode {
 public:
  using Config = ScanningConfig;
  static constexpr const char* kComponent = "scanning";

  ScanningNode(const Config& config, Ports& ports);

  SimTime step(SimTime now);

 private:
  void transmit(SimTime now);
  void publish(const PingUnderWay& ping);

  double frequency_hz_;
  ScanningHead head_;
  HeadInputs inputs_;
  PingCycle cycle_;
  Ports::Out<msg::Ping> ping_out_;
};

}  // namespace ensonify
