#pragma once

#include "components/forward_looking/head.h"
#include "components/sonar/head_node.h"

namespace ensonify {

/// An image per ping.
class ForwardLooking {
 public:
  using Config = ForwardLookingConfig;
  static constexpr const char* kComponent = "forward_looking";

  static HeadPlan plan(const Config& config);

  ForwardLooking(const Config& config, std::size_t) : config_(config), head_(config) {}

  HeadOutputs<msg::Ping> outputs() const { return {{"ping", head_.max_ping_bytes()}}; }
  SentPing transmit(SimTime now, const HeadSettings& settings, const HeadInputs& inputs) const;
  HeadReport<msg::Ping> ping(const PingEvent& event, const SentPing& sent, HeadInputs& inputs);

 private:
  Config config_;
  ForwardLookingHead head_;
};

using ForwardLookingNode = HeadNode<ForwardLooking>;

}  // namespace ensonify
