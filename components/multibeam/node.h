#pragma once

#include <optional>

#include "components/multibeam/head.h"
#include "components/multibeam/soundings.h"
#include "components/multibeam/steering.h"
#include "components/sonar/auto_range.h"
#include "components/sonar/head_node.h"
#include "messages/navigation.h"

namespace ensonify {

/// A swath per ping: its image, soundings, and if asked for snippets and the seabed's image. The motion sensor and the
/// probe steer it.
class Multibeam {
 public:
  using Config = MultibeamConfig;
  static constexpr const char* kComponent = "multibeam";
  using Report = HeadReport<msg::Ping, msg::Soundings, msg::Snippets, msg::SeabedImage>;
  struct Sent {
    std::vector<Transmission> sectors;
    Steering steering;
  };

  static HeadPlan plan(const Config& config);

  Multibeam(const Config& config, std::size_t);

  HeadOutputs<msg::Ping, msg::Soundings, msg::Snippets, msg::SeabedImage> outputs() const;
  void connect(Ports& ports);
  Sent transmit(SimTime now, HeadSettings settings, const HeadInputs& inputs);
  Report ping(const PingEvent& event, const Sent& sent, HeadInputs& inputs);

 private:
  void follow_range(const HeadSettings& settings);
  SteeringInputs steering_inputs(SimTime now, const HeadInputs& inputs) const;
  void add_images(const Sent& sent, const Placed& placed, Report& report) const;

  Config config_;
  MultibeamHead head_;
  MultibeamHead::Ping received_;
  refraction::SoundSpeedProfile applied_;
  SoundingMaker soundings_;
  SoundingMaker::Memory sounding_memory_;
  ReliefEstimator relief_;
  AutoRange range_;
  double swath_of_range_rad_;                 // that range_ knows
  std::optional<frames::Attitude> attitude_;  // the newest that the motion sensor gave
  HeadingMean heading_;
};

using MultibeamNode = HeadNode<Multibeam>;

}  // namespace ensonify
