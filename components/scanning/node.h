#pragma once

#include "components/runtime/head/single_channel.h"
#include "components/scanning/head.h"

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
