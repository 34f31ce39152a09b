#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "components/multibeam/arrays.h"
#include "components/multibeam/config.h"
#include "components/multibeam/detector.h"
#include "components/multibeam/sector.h"
#include "components/multibeam/soundings.h"
#include "components/multibeam/steering.h"
#include "components/sonar/auto_range.h"
#include "components/sonar/expected_echoes.h"
#include "components/sonar/head_node.h"
#include "components/sonar/shot_design.h"
#include "messages/navigation.h"

namespace ensonify {

/// A Mills-cross head, a swath per ping: its image, soundings, and if asked for snippets and the seabed's image. The
/// motion sensor and the probe steer it. All five stages.
class Multibeam {
 public:
  using Config = MultibeamConfig;
  static constexpr const char* kComponent = "multibeam";
  using Report = HeadReport<msg::Ping, msg::Soundings, msg::Snippets, msg::SeabedImage, msg::Energies>;
  struct Sent {
    std::vector<Transmission> sectors;
    Steering steering;
  };

  /// What follows from the settings of a ping.
  struct Design {
    double pulse_length_s, swath_rad;
    std::vector<Sector::Design> sectors;

    bool fits(const HeadSettings& settings) const {
      return pulse_length_s == settings.pulse_length_s && swath_rad == settings.swath_rad;
    }
  };

  static HeadPlan plan(const Config& config);

  /// The configuration outlives the head.
  Multibeam(const Config& config, std::size_t channel);
  Multibeam(const Multibeam&) = delete;
  Multibeam& operator=(const Multibeam&) = delete;

  HeadOutputs<msg::Ping, msg::Soundings, msg::Snippets, msg::SeabedImage, msg::Energies> outputs() const;
  void connect(Ports& ports);
  Sent transmit(SimTime now, HeadSettings settings, const Surroundings& around);
  Design prepare(const HeadSettings& settings) const;
  Report ping(const PingEvent& event, const Sent& sent, const Surroundings& around);

  /// Scratch: its contents do not matter. Results of the stages lie in it until it is used again.
  struct Memory {
    std::optional<Design> design;  // of the newest ping
    std::vector<Sector::Memory> sectors;
    std::vector<Sector::Sent> sent;
    std::vector<Echoed> echoed;
    std::vector<SectorBeams> beams;
    std::shared_ptr<std::vector<float>> amplitude_upa;  // of all beams; a new one while messages still hold the last
    Detector::Memory detection;
    SoundingMaker::Memory soundings;
    // Of energies.
    std::vector<Sector::Memory> expected;
    std::vector<Echoed> expected_echoed;
  };

  /// The first three stages of a ping, sector by sector; together a function of event, settings, steering, poses and
  /// tiles. The truth has a pose.
  std::span<const Sector::Sent> insonify(const PingEvent& event, const HeadSettings& settings, const Design& design,
                                         const Steering& steering, const Surroundings& around, Memory& memory) const;
  std::span<const Echoed> echoes(std::span<const Sector::Sent> sent, Memory& memory) const;
  std::span<const SectorBeams> beamform(const PingEvent& event, const HeadSettings& settings, const Steering& steering,
                                        std::span<const Sector::Sent> sent, std::span<const Echoed> echoed,
                                        Memory& memory) const;

  const ArrayDesign& arrays() const { return arrays_; }

  /// What later pings depend on.
  struct State {
    ReliefEstimator relief;
    AutoRange range;
    double swath_of_range_rad;                 // that the range knows
    std::optional<frames::Attitude> attitude;  // the newest that the motion sensor gave
    HeadingMean heading;
  };
  State& state() { return state_; }

 private:
  void follow_range(const HeadSettings& settings);
  SteeringInputs steering_inputs(SimTime now, const Surroundings& around) const;
  msg::Energies energies_of(const PingEvent& event, const HeadSettings& settings, const Steering& steering,
                            std::span<const Sector::Sent> sent);
  void add_images(const Sent& sent, const Placed& placed, std::span<const SectorBeams> beams, Report& report) const;

  const Config& config_;
  ArrayDesign arrays_;
  std::deque<Sector> sectors_;
  std::deque<Sector> expectations_;  // the same without speckle, where energies are asked for
  refraction::SoundSpeedProfile applied_;
  Detector detector_;
  SoundingMaker soundings_;
  Memory memory_;
  State state_;
};

}  // namespace ensonify
