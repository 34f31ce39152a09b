#include "components/autopilot/depth_keeper.h"

#include <algorithm>

namespace ensonify {
namespace {

constexpr SimTime kBottomValid = std::chrono::seconds(10);
constexpr double kSettle_s = 2.0;  // of the bottom's track: ten readings of an altimeter at 5 Hz

bool gives_depth(const Mission& mission) {
  const auto goes = [](const MissionStep& step) {
    const auto* go = std::get_if<GoAt>(&step);
    return go != nullptr && (go->depth_m || go->altitude_m);
  };
  const AbortRules& abort = mission.abort;
  return mission.depth_m > 0.0 || mission.altitude_m || mission.least_altitude_m > 0.0 || abort.after_s ||
         abort.position_sd_m || abort.too_low_s || mission.when_silent == WhenSilent::kSurface ||
         std::any_of(mission.steps.begin(), mission.steps.end(), goes);
}

}  // namespace

bool needs_altimeter(const Mission& mission) {
  const auto follows = [](const MissionStep& step) {
    const auto* go = std::get_if<GoAt>(&step);
    return go != nullptr && go->altitude_m;
  };
  return mission.altitude_m || mission.least_altitude_m > 0.0 || std::ranges::any_of(mission.steps, follows);
}

DepthKeeper::DepthKeeper(const Mission& mission, double climb_mps)
    : steers_(gives_depth(mission)),
      mission_depth_m_(mission.depth_m),
      depth_m_(mission.depth_m),
      above_m_(mission.altitude_m) {
  rules_.least_altitude_m = mission.least_altitude_m;
  // Time for the way that the floor leaves, at the fastest climb: what rises steadily is cleared in time.
  rules_.lookahead_s = 5.0 + 0.5 * mission.least_altitude_m / climb_mps;
}

void DepthKeeper::go_at(const GoAt& order) {
  if (order.depth_m) {
    depth_m_ = *order.depth_m;
    above_m_.reset();
  }
  if (order.altitude_m) above_m_ = order.altitude_m;
}

bool DepthKeeper::has_recent_bottom(SimTime now) const { return bottom_.known && now - bottom_at_ <= kBottomValid; }

bool DepthKeeper::bottom_lost(SimTime now) const {
  return (above_m_ || rules_.least_altitude_m > 0.0) && now - bottom_at_ > kBottomValid;
}

void DepthKeeper::take_altitude(SimTime at, double altitude_m, double depth_m) {
  if (bottom_.known && at <= bottom_at_) return;
  if (!has_recent_bottom(at)) bottom_ = {};
  bottom_ = guidance::track_bottom(bottom_, depth_m, altitude_m, seconds(at - bottom_at_), kSettle_s);
  altitude_m_ = altitude_m;
  bottom_at_ = at;
}

guidance::HeightOrder DepthKeeper::order(SimTime now, double depth_m) const {
  const bool knows = has_recent_bottom(now);
  const guidance::BottomTrack bottom = knows ? bottom_ : guidance::BottomTrack{};
  if (!above_m_) return guidance::hold_depth(rules_, bottom, depth_m_, depth_m, altitude_m_);
  if (!knows) return {bottom_.known ? std::min(mission_depth_m_, depth_m) : mission_depth_m_, false};
  guidance::HeightRules rules = rules_;
  rules.altitude_m = std::max(*above_m_, rules.least_altitude_m);
  return guidance::follow_bottom(rules, bottom, depth_m, altitude_m_);
}

}  // namespace ensonify
