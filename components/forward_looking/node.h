#pragma once

#include "components/forward_looking/head.h"
#include "components/sonar/single_channel.h"

namespace ensonify {

/// An image per ping.
class ForwardLookingNode {
 public:
  using Config = ForwardLookingConfig;
  static constexpr const char* kComponent = "forward_looking";

  ForwardLookingNode(const Config& config, Ports& ports);

  SimTime step(SimTime now);

 private:
  Config config_;
  ForwardLookingHead head_;
  SingleChannel channel_;
};

}  // namespace ensonify
