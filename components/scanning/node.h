#pragma once

#include "components/scanning/head.h"
#include "components/sonar/head_node.h"

namespace ensonify {

/// A row per ping. The transducer turns between pings.
class Scanning {
 public:
  using Config = ScanningConfig;
  static constexpr const char* kComponent = "scanning";

  static HeadPlan plan(const Config& config);

  Scanning(const Config& config, std::size_t) : frequency_hz_(config.frequency_hz), head_(config) {}

  HeadOutputs<msg::Ping> outputs() const { return {{"ping", head_.max_ping_bytes()}}; }
  SentPing transmit(SimTime now, const HeadSettings& settings, const HeadInputs& inputs) const;
  HeadReport<msg::Ping> ping(const PingEvent& event, const SentPing& sent, HeadInputs& inputs);

 private:
  double frequency_hz_;
  ScanningHead head_;
};

using ScanningNode = HeadNode<Scanning>;

}  // namespace ensonify
