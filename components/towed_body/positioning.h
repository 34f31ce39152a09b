#pragma once

#include <deque>
#include <optional>

#include "components/runtime/sim_time.h"
#include "components/towed_body/config.h"
#include "kernels/base/random/stream.h"
#include "messages/motion.h"
#include "messages/navigation.h"

namespace ensonify {

/// Estimate of the body's place, aboard: by the vessel's estimate, and what cable, fixes and the body's own depth,
/// heading and level sensors give.
class TowEstimator {
 public:
  explicit TowEstimator(const TowedBodyConfig& config);

  void take(const msg::Estimate& vessel);
  void take(const msg::UsblFix& fix);

  /// For the event n at `now`, when the body is truly there; nothing before the vessel, or by USBL a fix, is known.
  std::optional<msg::Estimate> estimate(SimTime now, std::uint64_t n, const frames::Pose& body);

 private:
  struct Place {
    frames::Vec2 enu_m;
    double sigma_m;  // each horizontal axis
  };
  Place by_layback(double height_m) const;
  std::optional<Place> by_usbl(SimTime now, double heading_rad);
  double vessel_speed_mps() const;

  TowedBodyConfig config_;
  random::Stream noise_;
  std::optional<msg::Estimate> vessel_;
  std::deque<frames::Vec3> sheave_enu_m_;  // where it was, a metre or more apart; the newest last
  std::optional<msg::UsblFix> fix_;        // not used yet
  std::optional<frames::Vec2> followed_enu_m_;
  SimTime followed_at_{0};
  double fix_sigma_m_ = 0.0;
};

}  // namespace ensonify
