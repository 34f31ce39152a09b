#include "components/autopilot/abort_monitor.h"

#include <algorithm>
#include <cmath>

namespace ensonify {

void Headway::observe(SimTime now, double to_go_m) {
  constexpr double kStep_m = 1.0;
  if (nearest_m_ && to_go_m > *nearest_m_ - kStep_m) return;
  nearest_m_ = to_go_m;
  nearest_at_ = now;
}

void AbortMonitor::observe(SimTime now, bool too_low) {
  if (!too_low) {
    too_low_since_.reset();
  } else if (!too_low_since_) {
    too_low_since_ = now;
  }
}

void AbortMonitor::go(SimTime now, std::optional<double> to_go_m, bool another_goal) {
  if (!to_go_m || another_goal) headway_.start_anew();
  if (to_go_m) headway_.observe(now, *to_go_m);
}

std::string AbortMonitor::why(SimTime now, const msg::Estimate& estimate) const {
  const auto& variance = estimate.position_covariance_enu_m2;
  const double sd_m = std::sqrt(std::max(variance[0], variance[4]));
  if (rules_.after_s && seconds(now) >= *rules_.after_s) return "it took longer than abort.after_s";
  if (rules_.position_sd_m && sd_m > *rules_.position_sd_m) return "the place is less certain than abort.position_sd_m";
  if (rules_.too_low_s && too_low_since_ && seconds(now - *too_low_since_) >= *rules_.too_low_s) {
    return "below the obstacle floor for abort.too_low_s";
  }
  if (headway_.lost(now))
    return "no metre nearer to the goal in patience_s: the current may be stronger than the vehicle";
  return "";
}

}  // namespace ensonify
