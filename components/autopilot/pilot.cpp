#include "components/autopilot/pilot.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "components/runtime/assert.h"

namespace ensonify {
namespace {

constexpr double kLag_s = 0.2;  // from an estimate to the vehicle's obeying: half a period and the command's delay
constexpr double kLeastLookahead_s = 2.0;  // ten lags: the loop stays damped at any speed
constexpr double kLinedUp_rad = 0.5;

const char* name_of(Pilot::State state) {
  switch (state) {
    case Pilot::State::kTurn: return "turn";
    case Pilot::State::kRunIn: return "run_in";
    case Pilot::State::kOnLine: return "on_line";
    case Pilot::State::kDone: return "done";
  }
  return "";
}

}  // namespace

Pilot::Pilot(const AutopilotConfig& config, std::vector<navigation::Runline> lines)
    : speed_mps_(config.plan.mission.speed_mps),
      turn_speed_mps_(config.plan.mission.speed_mps * config.turn_speed_fraction),
      run_in_m_(config.plan.mission.run_in_m),
      turning_radius_m_(config.plan.limits.turning_radius_m),
      planned_radius_m_(config.plan.limits.turning_radius_m * config.turn_margin),
      lookahead_radii_(config.lookahead_radii),
      lines_(std::move(lines)) {
  ENSONIFY_ASSERT(!lines_.empty(), "a pilot needs a line");
}

double Pilot::lookahead_m() const {
  return std::max(lookahead_radii_ * turning_radius_m_, kLeastLookahead_s * here_.speed_mps);
}

/// Before the line, close to its extension and pointing along it: guidance along the line does the rest.
bool Pilot::lined_up() const {
  const auto at = navigation::line_position(line(), here_.waypose.position_enu_m);
  const double off_rad = frames::wrap_pi(here_.waypose.heading_rad - navigation::heading_rad(line()));
  return std::abs(off_rad) < kLinedUp_rad && std::abs(at.cross_track_m) < 0.5 * turning_radius_m_ && at.along_m < 1.0 &&
         at.along_m > -run_in_m_ - 5.0 * turning_radius_m_;
}

void Pilot::head_for_line() {
  if (lined_up()) {
    state_ = State::kRunIn;
    return;
  }
  state_ = State::kTurn;
  const navigation::Waypose goal{navigation::extended(line(), run_in_m_, 0.0).start_enu_m,
                                 navigation::heading_rad(line())};
  turn_ = navigation::shortest_turn(here_.waypose, goal, planned_radius_m_);
  along_turn_m_ = 0.0;
}

void Pilot::follow_turn() {
  const double step_m = std::max(0.25, here_.speed_mps * kLag_s);
  along_turn_m_ = navigation::nearest_along_m(turn_, here_.waypose.position_enu_m, along_turn_m_, 10.0 * step_m);
  if (along_turn_m_ > turn_.length_m() - step_m) {
    state_ = State::kRunIn;
  } else if ((turn_.at(along_turn_m_).position_enu_m - here_.waypose.position_enu_m).norm() > 2.0 * planned_radius_m_) {
    head_for_line();  // lost the path: take a new one from here
  }
}

void Pilot::update(const msg::Estimate& estimate) {
  const auto& p = estimate.position_enu_m;
  const auto& v = estimate.velocity_enu_mps;
  here_ = {{{p[0], p[1]}, frames::attitude_of(frames::quaternion_of(estimate.enu_from_body)).heading_rad},
           std::hypot(v[0], v[1])};
  if (!std::exchange(begun_, true)) head_for_line();
  if (state_ == State::kTurn) follow_turn();
  const auto along_m = [&] { return navigation::line_position(line(), here_.waypose.position_enu_m).along_m; };
  if (state_ == State::kRunIn && along_m() >= 0.0) state_ = State::kOnLine;
  if (state_ == State::kOnLine && along_m() >= navigation::length_m(line())) {
    if (line_ + 1 == lines_.size()) {
      state_ = State::kDone;
    } else {
      ++line_;
      head_for_line();
    }
  }
}

msg::Guidance Pilot::command(SimTime now) const {
  msg::Guidance guidance;
  guidance.stamp_ns = now.count();
  const auto& place = here_.waypose.position_enu_m;
  switch (state_) {
    case State::kTurn:  // steer as the path will bend when the command takes effect
      guidance.heading_grid_rad = frames::wrap_two_pi(
          navigation::follow_heading_rad(turn_, place, along_turn_m_, lookahead_m()) +
          turn_.at(along_turn_m_ + here_.speed_mps * kLag_s).heading_rad - turn_.at(along_turn_m_).heading_rad);
      guidance.speed_mps = turn_speed_mps_;
      break;
    case State::kRunIn:
    case State::kOnLine:
      guidance.heading_grid_rad = navigation::line_of_sight_heading_rad(line(), place, lookahead_m());
      guidance.speed_mps = speed_mps_;
      break;
    case State::kDone:
      guidance.heading_grid_rad = navigation::heading_rad(line());
      guidance.speed_mps = 0.0;
      break;
  }
  return guidance;
}

msg::MissionState Pilot::mission_state(SimTime now) const {
  const auto at = navigation::line_position(line(), here_.waypose.position_enu_m);
  msg::MissionState mission;
  mission.stamp_ns = now.count();
  mission.state = name_of(state_);
  mission.line = static_cast<std::int64_t>(line_) - (state_ == State::kTurn ? 1 : 0);
  mission.line_count = static_cast<std::int64_t>(lines_.size());
  mission.cross_track_m = at.cross_track_m;
  mission.distance_to_go_m = navigation::length_m(line()) - at.along_m;
  return mission;
}

}  // namespace ensonify
