#pragma once

#include <deque>
#include <vector>

#include "components/runtime/head/ping_clock.h"
#include "components/runtime/head/tile_set.h"
#include "components/runtime/ports.h"
#include "components/sidescan/head.h"
#include "messages/motion.h"
#include "messages/navigation.h"
#include "messages/sonar.h"

namespace ensonify {

/// Two kinds of event: a transmission of all channels at once, at which the settings of the ping are fixed, and the end
/// of its processing, at which every pose it needs has arrived and it is computed and published.
class SidescanNode {
 public:
  using Config = SidescanConfig;
  static constexpr const char* kComponent = "sidescan";

  SidescanNode(const Config& config, Ports& ports);

  SimTime step(SimTime now);

 private:
  struct Channel {
    SidescanChannel config;
    CommandedSettings settings;
    SidescanHead head;
    Ports::Out<msg::Ping> ping_out;
    Ports::Out<msg::BottomTrack> bottom_out;
  };
  struct Pending {
    std::int64_t ping = 0;
    SimTime transmit{0};
    SimTime ready{0};
    std::vector<HeadSettings> settings;  // by channel
  };

  void command(const msg::SonarSettings& wanted);
  void transmit(SimTime now);
  void receive(const Pending& pending);
  void skip(const std::string& why);

  Ports& ports_;
  Config config_;
  std::vector<Channel> channels_;
  PingClock clock_;
  TileSet tiles_;
  frames::PoseHistory truth_, estimate_;
  std::deque<Pending> pending_;
  std::int64_t pings_ = 0;
  Ports::Out<msg::Transmit> transmit_out_;
};

}  // namespace ensonify
