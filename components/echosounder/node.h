#pragma once

#include "components/echosounder/head.h"
#include "components/sonar/single_channel.h"

namespace ensonify {

/// An echogram's column and a depth per ping.
class EchosounderNode {
 public:
  using Config = EchosounderConfig;
  static constexpr const char* kComponent = "echosounder";

  EchosounderNode(const Config& config, Ports& ports);

  SimTime step(SimTime now);

 private:
  Config config_;
  EchosounderHead head_;
  SingleChannel channel_;
  Ports::Out<msg::BottomTrack> bottom_out_;
};

}  // namespace ensonify
