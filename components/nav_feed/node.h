#pragma once

#include <optional>
#include <vector>

#include "components/feeds/feed_input.h"
#include "components/nav_feed/config.h"
#include "components/nav_feed/fed_track.h"
#include "components/nav_feed/source_decoder.h"
#include "components/runtime/ports.h"
#include "components/runtime/rate_limit.h"
#include "kernels/vehicle/vertical/floating.h"
#include "messages/motion.h"
#include "messages/terrain.h"

namespace ensonify {

/// Stands in for a vehicle: its true pose is what sentences from outside give.
class NavFeedNode {
 public:
  using Config = NavFeedConfig;
  static constexpr const char* kComponent = "nav_feed";

  NavFeedNode(const Config& config, Ports& ports);

  SimTime step(SimTime now);

 private:
  void receive(SimTime now);
  void take(const FedPiece& piece, SimTime now);
  frames::MovingPose at_its_height(frames::MovingPose moving, SimTime now);

  Config config_;
  Ports& ports_;
  Periodic poses_due_;
  std::vector<SourceDecoder> decoders_;         // one of each source
  std::optional<FedTrack> track_;               // from when the world's origin is known on
  std::optional<vertical::Floating> floating_;  // from its first pose on
  Ports::Out<msg::Pose> poses_;
  Ports::Out<msg::Position> fixes_;
  FeedInput input_;
  RateLimit fixes_allowed_;
};

}  // namespace ensonify
