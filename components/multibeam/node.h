#pragma once

#include <deque>
#include <optional>

#include "components/multibeam/head.h"
#include "components/multibeam/soundings.h"
#include "components/runtime/head/auto_range.h"
#include "components/runtime/head/ping_clock.h"
#include "components/runtime/head/tile_set.h"
#include "components/runtime/ports.h"
#include "messages/motion.h"
#include "messages/navigation.h"
#include "messages/sonar.h"

namespace ensonify {

/// Two kinds of event: a transmission, at which the settings of the ping are fixed, and the end of its processing, at
/// which every pose it needs has arrived and it is computed and published.
class MultibeamNode {
 public:
  using Config = MultibeamConfig;
  static constexpr const char* kComponent = "multibeam";

  MultibeamNode(const Config& config, Ports& ports);

  SimTime step(SimTime now);

 private:
  struct Pending {
    Shot shot;
    Belief belief;
    SimTime ready{0};
  };

  void transmit(SimTime now);
  Belief belief(SimTime now) const;
  void receive(const Shot& shot, const Belief& belief);
  void report(const Shot& shot, std::size_t detections);
  void skip(const std::string& why);

  Ports& ports_;
  Config config_;
  MultibeamHead head_;
  refraction::SoundSpeedProfile applied_;
  SoundingMaker soundings_;
  PingClock clock_;
  AutoRange range_;
  TileSet tiles_;
  frames::PoseHistory truth_, estimate_;
  std::optional<double> probe_mps_;           // the newest that the probe at the face told
  std::optional<frames::Attitude> attitude_;  // likewise the motion sensor
  std::deque<Pending> pending_;
  std::int64_t pings_ = 0;
  Ports::Out<msg::Ping> ping_out_;
  Ports::Out<msg::Soundings> soundings_out_;
  Ports::Out<msg::Transmit> transmit_out_;
};

}  // namespace ensonify
