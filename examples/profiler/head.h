#pragma once

#include <optional>
#include <vector>

#include "components/sonar/aperture_echoes.h"
#include "components/sonar/head_node.h"
#include "components/sonar/shot_design.h"
#include "examples/profiler/config.h"

namespace ensonify {

/// The whole head, as HeadNode runs it: a beam of Gaussian shape and the range of its strongest echo. A profiler places
/// nothing: of the five stages it has the first four.
class Profiler {
 public:
  using Config = ProfilerConfig;
  static constexpr const char* kComponent = "profiler";
  using Report = HeadReport<msg::Ping, msg::BottomTrack>;

  /// What follows from the settings of a ping.
  struct Design {
    double range_m;
    echo::Sampling sampling;
    ShotDesign shot;

    bool fits(const HeadSettings& settings) const { return range_m == settings.range_m; }
  };

  static HeadPlan plan(const Config& config);

  /// The configuration outlives the head.
  Profiler(const Config& config, std::size_t channel);

  HeadOutputs<msg::Ping, msg::BottomTrack> outputs() const;
  SentPing transmit(SimTime now, const HeadSettings& settings, const Surroundings& around) const;
  Design prepare(const HeadSettings& settings) const;
  Report ping(const PingEvent& event, const SentPing& sent, const Surroundings& around);

 private:
  msg::BottomTrack detect(const PingEvent& event, const Design& design, const echo::Image& image) const;
  msg::Ping ping_message(const PingEvent& event, const HeadSettings& settings, const Design& design,
                         const echo::Image& image) const;

  /// Scratch: its contents do not matter.
  struct Memory {
    std::optional<Design> design;  // of the newest ping
    std::vector<frames::HeadPose> poses;
    ShotMemory shot;
    ApertureEchoes::Memory beams;
  };

  const Config& config_;
  ApertureEchoes echoes_;
  Memory memory_;
};

}  // namespace ensonify
