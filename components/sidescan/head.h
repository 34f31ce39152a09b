#pragma once

#include <optional>
#include <vector>

#include "components/sidescan/config.h"
#include "components/sonar/aperture_echoes.h"
#include "components/sonar/bottom_finder.h"
#include "components/sonar/expected_echoes.h"
#include "components/sonar/head_node.h"
#include "components/sonar/labeller.h"
#include "components/sonar/line_design.h"
#include "components/sonar/shot_design.h"

namespace ensonify {

/// The patterns of a channel, port then starboard: a uniform line along x, another across the face, the face's back.
AperturePatterns side_patterns(const SidescanConfig& config, const SidescanChannel& channel);

/// One channel of a sidescan: what both sides receive of a ping, and where the instrument finds the bottom in it. The
/// acoustics use the true motion, mounting and water; the track of the bottom only what was received. A sidescan places
/// nothing: of the five stages it has the first four.
class Sidescan {
 public:
  using Config = SidescanConfig;
  static constexpr const char* kComponent = "sidescan";
  using Report = HeadReport<msg::Ping, msg::BottomTrack, msg::Labels, msg::Energies>;

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
  Sidescan(const Config& config, std::size_t channel);

  HeadOutputs<msg::Ping, msg::BottomTrack, msg::Labels, msg::Energies> outputs() const;
  SentPing transmit(SimTime now, const HeadSettings& settings, const Surroundings& around) const;
  Design prepare(const HeadSettings& settings) const;
  Report ping(const PingEvent& event, const SentPing& sent, const Surroundings& around);

  /// What later pings depend on.
  struct State {
    detect::BottomTrack bottom;
  };
  State& state() { return state_; }

 private:
  Sidescan(const Config& config, const SidescanChannel& channel, const LineDesign& line);

  msg::Ping ping_message(const PingEvent& event, const HeadSettings& settings, const Design& design,
                         const echo::Image& image) const;

  /// Scratch: its contents do not matter.
  struct Memory {
    std::optional<Design> design;  // of the newest ping
    std::vector<frames::HeadPose> poses;
    ShotMemory shot;
    ApertureEchoes::Memory beams;
    Labeller::Memory labels;
    ExpectedEchoes<ApertureEchoes>::Memory expected;
    BottomFinder::Memory bottom;
  };

  const Config& config_;
  const SidescanChannel& channel_;  // of the configuration
  trace::RayDistribution rays_;
  ApertureEchoes echoes_;
  BottomFinder bottom_;
  std::vector<label::Row> label_rows_;
  std::optional<Labeller> labeller_;
  std::optional<ExpectedEchoes<ApertureEchoes>> expectation_;
  Memory memory_;
  State state_;
};

}  // namespace ensonify
