#pragma once

#include <optional>
#include <vector>

#include "components/echosounder/config.h"
#include "components/sonar/aperture_echoes.h"
#include "components/sonar/bottom_finder.h"
#include "components/sonar/head_node.h"
#include "components/sonar/shot_design.h"

namespace ensonify {

/// A single-beam echosounder: echoes of a ping at the piston, and the bottom that the instrument finds in them. The
/// acoustics use the true motion, mounting and water; the bottom only what was received. An echosounder places
/// nothing: of the five stages it has the first four.
class Echosounder {
 public:
  using Config = EchosounderConfig;
  static constexpr const char* kComponent = "echosounder";
  using Report = HeadReport<msg::Ping, msg::BottomTrack>;

  /// What follows from the settings of a ping.
  struct Design {
    double range_m, pulse_length_s;
    echo::Sampling sampling;
    ShotDesign shot;

    bool fits(const HeadSettings& settings) const {
      return range_m == settings.range_m && pulse_length_s == settings.pulse_length_s;
    }
  };

  static HeadPlan plan(const Config& config);

  /// The configuration outlives the head.
  Echosounder(const Config& config, std::size_t channel);

  HeadOutputs<msg::Ping, msg::BottomTrack> outputs() const;
  SentPing transmit(SimTime now, const HeadSettings& settings, const Surroundings& around) const;
  Design prepare(const HeadSettings& settings) const;
  Report ping(const PingEvent& event, const SentPing& sent, const Surroundings& around);

  /// What later pings depend on.
  struct State {
    detect::BottomTrack bottom;
  };
  State& state() { return state_; }

 private:
  msg::Ping ping_message(const PingEvent& event, const HeadSettings& settings, const Design& design,
                         const echo::Image& image) const;

  /// Scratch: its contents do not matter.
  struct Memory {
    std::optional<Design> design;  // of the newest ping
    std::vector<frames::HeadPose> poses;
    ShotMemory shot;
    ApertureEchoes::Memory beams;
    BottomFinder::Memory bottom;
  };

  const Config& config_;
  ApertureEchoes echoes_;
  BottomFinder bottom_;
  Memory memory_;
  State state_;
};

}  // namespace ensonify
