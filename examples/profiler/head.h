#pragma once

#include <vector>

#include "components/sonar/aperture_echoes.h"
#include "components/sonar/head_node.h"
#include "examples/profiler/config.h"

namespace ensonify {

/// The whole head, as HeadNode runs it: a beam of Gaussian shape and the range of its strongest echo.
class Profiler {
 public:
  using Config = ProfilerConfig;
  static constexpr const char* kComponent = "profiler";

  static HeadPlan plan(const Config& config);

  Profiler(const Config& config, std::size_t channel);

  HeadOutputs<msg::Ping, msg::BottomTrack> outputs() const;
  SentPing transmit(SimTime now, const HeadSettings& settings, const HeadInputs& inputs) const;
  HeadReport<msg::Ping, msg::BottomTrack> ping(const PingEvent& event, const SentPing& sent, HeadInputs& inputs);

 private:
  Config config_;
  echo::Pulse pulse_;
  ApertureEchoes echoes_;
  ApertureEchoes::Memory memory_;
  std::vector<frames::HeadPose> poses_;
};

}  // namespace ensonify
