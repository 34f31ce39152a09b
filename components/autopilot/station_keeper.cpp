#include "components/autopilot/station_keeper.h"

#include <cmath>

#include "kernels/vehicle/guidance/laws.h"

namespace ensonify {
namespace {

constexpr double kApproach_ps = 0.2;  // speed over ground per metre outside the watch circle
constexpr double kArrived = 1.5;      // watch circles from the place within which it counts as kept
constexpr double kSteady_s =
    5.0;  // a vehicle makes what it was commanded some of these after the order has last changed
constexpr double kSteady_mps = 0.1;    // an order that has changed less lately is steady
constexpr double kOther_mps = 0.2;     // a current that differs by more is another one
constexpr double kUpstream_rad = 0.5;  // a bow so near to upstream needs no turn
constexpr double kLookahead = 1.5;     // turning radii
constexpr double kSettle = 2.0;        // turning radii, to line up after a turn
constexpr double kLost = 2.0;          // turning radii beside the way up

}  // namespace

StationKeeper::StationKeeper(const motion::Limits& limits, double lag_s, double settle_s, double period_s)
    : limits_(limits), lag_s_(lag_s), settle_s_(settle_s), period_s_(period_s) {}

guidance::StationRules StationKeeper::rules(double speed_mps) const {
  return {keep_.within_m, kApproach_ps, speed_mps, limits_.deceleration_mps2, lag_s_};
}

void StationKeeper::observe(const runlines::Vec2& velocity_enu_mps, double heading_rad, double commanded_mps,
                            bool straight) {
  commanded_lately_mps_ += (1.0 - std::exp(-period_s_ / kSteady_s)) * (commanded_mps - commanded_lately_mps_);
  if (!straight || settle_s_ == 0.0 || std::abs(commanded_mps - commanded_lately_mps_) > kSteady_mps) return;
  current_enu_mps_ =
      guidance::learn_current(current_enu_mps_, velocity_enu_mps, heading_rad, commanded_mps, period_s_, settle_s_);
}

void StationKeeper::begin(const KeepPlace& keep, const runlines::Vec2& at_rest_enu_m) {
  keep_ = keep;
  place_enu_m_ = keep.place_enu_m.value_or(at_rest_enu_m);
  kept_since_.reset();
  planned_for_enu_mps_.reset();
}

bool StationKeeper::in_stream() const { return current_enu_mps_.norm() >= guidance::kStream_mps; }

runlines::Runline StationKeeper::way_up(double speed_mps) const {
  return guidance::upstream_way(rules(speed_mps), kSettle * limits_.turning_radius_m, place_enu_m_, current_enu_mps_);
}

bool StationKeeper::asks_for_approach(const runlines::Waypose& here, double speed_mps) const {
  if (!planned_for_enu_mps_) return true;
  if (!in_stream()) return false;
  const runlines::Runline way = way_up(speed_mps);
  const bool far =
      (place_enu_m_ - here.position_enu_m).norm() > runlines::length_m(way) + 2.0 * kLost * limits_.turning_radius_m;
  const bool other = (current_enu_mps_ - *planned_for_enu_mps_).norm() > kOther_mps;
  const double off_rad = frames::wrap_pi(here.heading_rad - runlines::heading_rad(way));
  const double off_m = runlines::line_position(way, here.position_enu_m).cross_track_m;
  return (far && other) || (!far && (std::cos(off_rad) < 0.0 || std::abs(off_m) > kLost * limits_.turning_radius_m));
}

std::optional<runlines::Waypose> StationKeeper::approach(const runlines::Waypose& here, double speed_mps) {
  planned_for_enu_mps_ = current_enu_mps_;
  if (!in_stream()) return std::nullopt;
  const runlines::Runline way = way_up(speed_mps);
  const auto at = runlines::line_position(way, here.position_enu_m);
  const double heading_rad = runlines::heading_rad(way);
  const bool on_it = std::abs(frames::wrap_pi(here.heading_rad - heading_rad)) < kUpstream_rad &&
                     std::abs(at.cross_track_m) < 0.5 * limits_.turning_radius_m;
  if (on_it && at.along_m < runlines::length_m(way) + keep_.within_m) return std::nullopt;
  return runlines::Waypose{way.start_enu_m, heading_rad};
}

bool StationKeeper::kept(SimTime now, const runlines::Vec2& here_enu_m, bool in_turn) {
  const bool there = !in_turn && (here_enu_m - place_enu_m_).norm() <= kArrived * keep_.within_m;
  if (!kept_since_ && (there || !keep_.place_enu_m)) kept_since_ = now;
  return kept_since_ && seconds(now - *kept_since_) >= keep_.for_s;
}

guidance::Steering StationKeeper::steer(const runlines::Waypose& here, double speed_mps) const {
  if (in_stream()) {
    return guidance::stem(rules(speed_mps), kLookahead * limits_.turning_radius_m, way_up(speed_mps),
                          here.position_enu_m, current_enu_mps_);
  }
  return guidance::keep_station(rules(speed_mps), place_enu_m_, here.position_enu_m, here.heading_rad,
                                current_enu_mps_);
}

}  // namespace ensonify
