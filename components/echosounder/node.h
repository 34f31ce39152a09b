#pragma once

#include "components/echosounder/head.h"
#include "components/sonar/head_node.h"

namespace ensonify {

/// An echogram's column and a depth per ping.
class Echosounder {
 public:
  using Config = EchosounderConfig;
  static constexpr const char* kComponent = "echosounder";

  static HeadPlan plan(const Config& config);

  Echosounder(const Config& config, std::size_t) : config_(config), head_(config) {}

  HeadOutputs<msg::Ping, msg::BottomTrack> outputs() const;
  SentPing transmit(SimTime now, const HeadSettings& settings, const HeadInputs& inputs) const;
  HeadReport<msg::Ping, msg::BottomTrack> ping(const PingEvent& event, const SentPing& sent, HeadInputs& inputs);

 private:
  Config config_;
  EchosounderHead head_;
};

using EchosounderNode = HeadNode<Echosounder>;

}  // namespace ensonify
