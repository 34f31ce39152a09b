#pragma once

#include <optional>
#include <vector>

#include "components/scanning/config.h"
#include "components/sonar/aperture_echoes.h"
#include "components/sonar/expected_echoes.h"
#include "components/sonar/head_node.h"
#include "components/sonar/labeller.h"
#include "components/sonar/line_design.h"
#include "components/sonar/shot_design.h"

namespace ensonify {

/// The pattern of the transducer, in its own frame: x along its axis's projection onto the plane that it turns in.
array::Pattern scanning_pattern(const ScanningConfig& config);

/// A mechanically scanned head: a row per ping, of what its one transducer receives where it points. It turns between
/// pings and stands still while it receives. Uses the true motion, the actual mounting and the true water. It neither
/// detects nor places: of the five stages it has the first three.
class Scanning {
 public:
  using Config = ScanningConfig;
  static constexpr const char* kComponent = "scanning";
  using Report = HeadReport<msg::Ping, msg::Labels, msg::Energies>;

  /// What follows from the settings of a ping.
  struct Design {
    double range_m, held_pulse_length_s;  // 0: the pulse follows the range
    RangedPulse ranged;
    ShotDesign shot;

    bool fits(const HeadSettings& settings) const {
      return range_m == settings.range_m && held_pulse_length_s == settings.pulse_length_s;
    }
  };

  static HeadPlan plan(const Config& config);

  /// The configuration outlives the head.
  Scanning(const Config& config, std::size_t channel);

  HeadOutputs<msg::Ping, msg::Labels, msg::Energies> outputs() const;
  SentPing transmit(SimTime now, const HeadSettings& settings, const Surroundings& around) const;
  Design prepare(const HeadSettings& settings) const;
  Report ping(const PingEvent& event, const SentPing& sent, const Surroundings& around);

 private:
  Scanning(const Config& config, const LineDesign& line);

  RangedPulse pulse_for(const HeadSettings& settings) const;
  msg::Ping ping_message(const PingEvent& event, const SentPing& sent, const Design& design, double angle_rad,
                         const echo::Image& image) const;

  /// Scratch: its contents do not matter.
  struct Memory {
    std::optional<Design> design;  // of the newest ping
    std::vector<frames::HeadPose> poses;
    ShotMemory shot;
    ApertureEchoes::Memory beams;
    Labeller::Memory labels;
    ExpectedEchoes<ApertureEchoes>::Memory expected;
  };

  const Config& config_;
  trace::RayDistribution rays_;
  ApertureEchoes echoes_;
  label::Row label_row_;
  std::optional<Labeller> labeller_;
  std::optional<ExpectedEchoes<ApertureEchoes>> expectation_;
  Memory memory_;
};

}  // namespace ensonify
