#pragma once

#include "components/scanning/head.h"
#include "components/sonar/single_channel.h"

namespace ensonify {

/// A row per ping. The transducer turns between pings.
class ScanningNode {
 public:
  using Config = ScanningConfig;
  static constexpr const char* kComponent = "scanning";

  ScanningNode(const Config& config, Ports& ports);

  SimTime step(SimTime now);

 private:
  double frequency_hz_;
  ScanningHead head_;
  SingleChannel channel_;
};

}  // namespace ensonify
