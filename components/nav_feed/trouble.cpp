// Why the vehicle is not where a good feed would have it, in words for health.
#include "components/nav_feed/fed_track.h"
#include "components/nav_feed/wording.h"

namespace ensonify {
namespace {

constexpr SimTime kDateJumpIsNamed = std::chrono::seconds(5);

std::string ahead_text(double ahead_s) { return duration_text(ahead_s) + (ahead_s > 0.0 ? " ahead of" : " behind"); }

void add_cause(std::string& causes, const std::string& cause) {
  if (!cause.empty()) causes += (causes.empty() ? "" : "; ") + cause;
}

}  // namespace

std::string FedTrack::lack_of_fixes(double t_s) const {
  if (east_m_.empty()) {
    if (trial_.is_on()) return "no place yet: a first fix counts when three in a row agree";
    return refusal_.empty() ? "no place yet: no fix has come" : "no place yet";
  }
  const double since_s = t_s - east_m_.newest_s();
  if (since_s <= 0.0) return "";
  return "no fix for " + duration_text(since_s) +
         (since_s <= config_.straight_on_s ? ": the vehicle goes straight on" : ": the vehicle stays where it is");
}

std::string FedTrack::trouble(SimTime now) const {
  const double t_s = delayed_s(now);
  std::string causes;
  if (!east_m_.empty() && trial_.is_on()) add_cause(causes, jump_ + ": not followed unless three fixes in a row agree");
  if (!jump_.empty() && !trial_.is_on() && t_s < jumped_at_s_)
    add_cause(causes, jump_ + ": the vehicle has not come there yet");
  add_cause(causes, refusal_);
  add_cause(causes, lack_of_fixes(t_s));
  if (now - date_jumped_at_ < kDateJumpIsNamed) add_cause(causes, date_jump_);
  if (east_m_.empty()) return causes;
  if (heading_rad_.empty()) add_cause(causes, "no heading has come");
  if (motion_ahead_s_ && !(trial_.is_on() && time_jumped_)) {
    add_cause(causes, "motion is " + ahead_text(*motion_ahead_s_) + " the fixes: not taken");
  }
  if (clock_ahead_s_ && !(trial_.is_on() && time_jumped_)) {
    add_cause(causes, "ZDA is " + ahead_text(*clock_ahead_s_) + " the fixes");
  }
  const auto held = [&](const motion::GappedCurve& curve, const std::string& what) {
    if (curve.empty() || t_s - curve.newest_s() <= config_.attitude_gap_s) return;
    add_cause(causes, "no " + what + " for " + duration_text(t_s - curve.newest_s()) + ": held");
  };
  held(heading_rad_, "heading");
  held(roll_rad_, "roll");
  held(pitch_rad_, "pitch");
  held(heave_m_, "heave");
  return causes;
}

}  // namespace ensonify
