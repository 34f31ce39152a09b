#pragma once

#include <deque>

#include "components/runtime/head/head_inputs.h"
#include "components/runtime/head/ping_clock.h"
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
  struct Pending {
    Shot shot;
    HeadSettings settings;
    double sound_speed_mps = 0.0;  // as the head knew it
    SimTime listening{0};
    SimTime ready{0};
  };

  void transmit(SimTime now);
  void receive(const Pending& pending);

  Ports& ports_;
  Config config_;
  ScanningHead head_;
  HeadInputs inputs_;
  PingClock clock_;
  std::deque<Pending> pending_;
  std::int64_t pings_ = 0;
  Ports::Out<msg::Ping> ping_out_;
  Ports::Out<msg::Transmit> transmit_out_;
};

}  // namespace ensonify
