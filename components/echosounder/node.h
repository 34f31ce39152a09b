#pragma once

#include <deque>

#include "components/echosounder/head.h"
#include "components/runtime/head/ping_clock.h"
#include "components/runtime/head/tile_set.h"
#include "components/runtime/ports.h"
#include "messages/motion.h"
#include "messages/navigation.h"

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
  struct Pending {
    Shot shot;
    SimTime ready{0};
    HeadSettings settings;
  };

  void transmit(SimTime now);
  void receive(const Pending& pending);
  void skip(const std::string& why);

  Ports& ports_;
  Config config_;
  CommandedSettings settings_;
  EchosounderHead head_;
  PingClock clock_;
  TileSet tiles_;
  frames::PoseHistory truth_, estimate_;
  std::deque<Pending> pending_;
  std::int64_t pings_ = 0;
  Ports::Out<msg::Ping> ping_out_;
  Ports::Out<msg::BottomTrack> bottom_out_;
  Ports::Out<msg::Transmit> transmit_out_;
};

}  // namespace ensonify
