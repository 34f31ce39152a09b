#include "components/autopilot/pilot.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>

#include "components/errors/assert.h"
#include "kernels/vehicle/guidance/laws.h"

namespace ensonify {
namespace {

constexpr double kLag_s = 0.2;  // from an estimate to the vehicle's obeying: half a period and the command's delay
constexpr double kLinedUp_rad = 0.5;
constexpr double kCircleGain = 2.0;  // at a radius outside, the course points 63 degrees inwards
constexpr double kOnCircle = 0.5;    // share of the radius within which an orbit counts
constexpr double kSurfaced_m = 1.0;
constexpr double kSlowestClimb = 0.5;  // share of the speed at which a vehicle that is too low goes on

const char* name_of(Pilot::State state) {
  switch (state) {
    case Pilot::State::kTurn: return "turn";
    case Pilot::State::kRunIn: return "run_in";
    case Pilot::State::kOnLine: return "on_line";
    case Pilot::State::kRunOut: return "run_out";
    case Pilot::State::kPass: return "pass";
    case Pilot::State::kKeep: return "keep";
    case Pilot::State::kOrbit: return "orbit";
    case Pilot::State::kAwaitLine: return "await_line";
    case Pilot::State::kStandBy: return "stand_by";
    case Pilot::State::kAbort: return "abort";
    case Pilot::State::kDone: return "done";
  }
  return "";
}

}  // namespace

Pilot::Pilot(const AutopilotConfig& config, std::vector<MissionStep> steps)
    : mission_(config.plan.mission),
      limits_(config.plan.limits),
      lookahead_radii_(config.lookahead_radii),
      turn_margin_(config.turn_margin),
      turn_speed_fraction_(config.turn_speed_fraction),
      drift_settle_s_(config.drift_settle_s),
      period_s_(1.0 / config.command_rate_hz),
      steps_(std::move(steps)),
      station_(limits_, kLag_s, drift_settle_s_, period_s_),
      speed_mps_(mission_.speed_mps),
      depth_(mission_, limits_.vertical_speed_mps),
      abort_monitor_(mission_.abort, config.patience_s) {
  ENSONIFY_ASSERT(!steps_.empty(), "a pilot needs a step");
  const auto lines = std::count_if(steps_.begin(), steps_.end(),
                                   [](const MissionStep& step) { return std::holds_alternative<FollowLine>(step); });
  line_count_ = mission_.repeat * static_cast<std::int64_t>(lines);
}

// --- steps ----------------------------------------------------------------------------------------------------------

/// Begins steps until one takes time, or the mission is done.
void Pilot::begin_step(SimTime now) {
  const State before = state_ = State::kDone;
  while (state_ == before) {
    if (step_ == steps_.size()) {
      if (mission_.adaptive) return await_line();
      if (++round_ >= mission_.repeat) return;
      step_ = 0;
    }
    const MissionStep& step = steps_[step_++];
    std::visit([&](const auto& what) { begin(what, now); }, step);
  }
}

void Pilot::begin(const FollowLine& line, SimTime) {
  pieces_.clear();
  for (std::size_t i = 1; i < line.points_enu_m.size(); ++i) {
    pieces_.push_back({line.points_enu_m[i - 1], line.points_enu_m[i]});
  }
  piece_ = 0;
  ++line_;
  line_name_ = line.name;
  head_for_line();
}

void Pilot::begin(const PassPlace& pass, SimTime) {
  const runlines::Vec2 way = pass.place_enu_m - here_.waypose.position_enu_m;
  const double towards_rad = way.norm() > 0.0 ? std::atan2(way.x(), way.y()) : here_.waypose.heading_rad;
  state_ = State::kPass;
  head_for({pass.place_enu_m, pass.heading_rad.value_or(towards_rad)});
}

void Pilot::begin(const KeepPlace& keep, SimTime) {
  state_ = State::kKeep;
  const double heading_rad = here_.waypose.heading_rad, rest_m = motion::stopping_distance_m(here_.speed_mps, limits_);
  const runlines::Vec2 at_rest =
      here_.waypose.position_enu_m + rest_m * runlines::Vec2(std::sin(heading_rad), std::cos(heading_rad));
  station_.begin(keep, at_rest);  // where it is: without turning back
  approaching_ = false;
}

void Pilot::begin(const FollowOrbit& orbit, SimTime) {
  state_ = State::kOrbit;
  circle_ = {orbit.centre_enu_m, orbit.radius_m, orbit.clockwise};
  to_sweep_rad_ = 2.0 * std::numbers::pi * orbit.turns;
}

void Pilot::begin(const GoAt& go, SimTime) {
  speed_mps_ = go.speed_mps.value_or(speed_mps_);
  depth_.go_at(go);
}

void Pilot::begin(const SetSonar& sonar, SimTime now) {
  msg::SonarSettings settings = sonar.settings;
  settings.stamp_ns = now.count();
  settings_.emplace_back(sonar.head, settings);
}

void Pilot::begin(const SetMark& mark, SimTime now) { marks_.push_back({now.count(), mark.text, position_enu_m_}); }

/// Goes straight on until the next line is known.
void Pilot::await_line() {
  state_ = State::kAwaitLine;
  if (!offered_ || offered_->number != line_ + 1) return;
  if (offered_->done) {
    state_ = State::kDone;
    return;
  }
  const auto& start = offered_->start_enu_m;
  const auto& end = offered_->end_enu_m;
  ++line_count_;
  begin(FollowLine{{{start[0], start[1]}, {end[0], end[1]}}}, {});
}

// --- lines and turns ------------------------------------------------------------------------------------------------

guidance::LineGains Pilot::gains() const {
  guidance::LineGains gains =
      guidance::line_gains(std::max(here_.speed_mps, 0.1), kLag_s, lookahead_radii_ * limits_.turning_radius_m);
  if (drift_settle_s_ == 0.0) gains.integral_mps = 0.0;
  return gains;
}

/// The circle over ground of a vehicle that turns while it is carried along is wider than that in the water.
double Pilot::planned_radius_m() const {
  const double carried = 1.0 + std::min(0.9, drift().norm() / std::max(turn_speed_mps(), 0.01));
  return motion::turning_circle_m(turn_speed_mps(), limits_) * turn_margin_ * carried * carried;
}

/// Before the line, close to its extension and pointing along it: guidance along the line does the rest.
bool Pilot::lined_up() const {
  const auto at = runlines::line_position(line(), here_.waypose.position_enu_m);
  const double off_rad = frames::wrap_pi(here_.waypose.heading_rad - runlines::heading_rad(line()));
  return std::abs(off_rad) < kLinedUp_rad && std::abs(at.cross_track_m) < 0.5 * limits_.turning_radius_m &&
         at.along_m < 1.0 && at.along_m > -mission_.run_in_m - 5.0 * limits_.turning_radius_m;
}

void Pilot::head_for_line() {
  integral_s_ = 0.0;
  if (lined_up()) {
    state_ = State::kRunIn;
    return;
  }
  state_ = State::kTurn;
  head_for({runlines::extended(line(), mission_.run_in_m, 0.0).start_enu_m, runlines::heading_rad(line())});
}

void Pilot::head_for(const runlines::Waypose& goal) {
  goal_ = goal;
  turn_ = runlines::shortest_turn(here_.waypose, goal, planned_radius_m());
  along_turn_m_ = 0.0;
}

/// Moves on along the turn; true at its end. A vehicle that has lost the path takes a new one from where it is.
bool Pilot::turn_done() {
  const double step_m = std::max(0.25, here_.speed_mps * kLag_s);
  const runlines::Vec2& place = here_.waypose.position_enu_m;
  along_turn_m_ = runlines::nearest_along_m(turn_, place, along_turn_m_, 10.0 * step_m);
  if (along_turn_m_ > turn_.length_m() - step_m) return true;
  if ((turn_.at(along_turn_m_).position_enu_m - place).norm() > 2.0 * planned_radius_m()) {
    if (state_ == State::kTurn) {
      head_for_line();
    } else {
      head_for(goal_);
    }
  }
  return false;
}

/// How far before a bend the vehicle leaves a piece, so that its circle touches the next one.
double Pilot::switch_before_end_m() const {
  if (piece_ + 1 == pieces_.size()) return 0.0;
  const double bend_rad =
      std::abs(frames::wrap_pi(runlines::heading_rad(pieces_[piece_ + 1]) - runlines::heading_rad(line())));
  constexpr double kSharpest_rad = 2.0;  // sharper bends are overshot: the circle would begin before the piece does
  return planned_radius_m() * std::tan(0.5 * std::min(bend_rad, kSharpest_rad));
}

double Pilot::to_go_m(double along_m) const {
  double to_go_m = runlines::length_m(line()) - along_m;
  for (std::size_t i = piece_ + 1; i < pieces_.size(); ++i) to_go_m += runlines::length_m(pieces_[i]);
  return to_go_m;
}

void Pilot::follow_line(SimTime now) {
  const auto at = [&] { return runlines::line_position(line(), here_.waypose.position_enu_m); };
  integral_s_ = guidance::next_integral_s(gains(), at().cross_track_m, integral_s_, period_s_);
  if (state_ == State::kRunIn && at().along_m >= 0.0) state_ = State::kOnLine;
  while (state_ == State::kOnLine && piece_ + 1 < pieces_.size() &&
         at().along_m >= runlines::length_m(line()) - switch_before_end_m()) {
    ++piece_;
    integral_s_ = 0.0;
  }
  if (state_ == State::kOnLine && at().along_m >= runlines::length_m(line())) state_ = State::kRunOut;
  if (state_ == State::kRunOut && at().along_m >= runlines::length_m(line()) + mission_.run_out_m) begin_step(now);
}

// --- stations -------------------------------------------------------------------------------------------------------

void Pilot::keep_place(SimTime now) {
  if (!approaching_ && station_.asks_for_approach(here_.waypose, speed_mps_)) {
    const auto begin = station_.approach(here_.waypose, speed_mps_);
    approaching_ = begin.has_value();
    if (begin) head_for(*begin);
  }
  if (approaching_) approaching_ = !turn_done();
  if (station_.kept(now, here_.waypose.position_enu_m, approaching_)) begin_step(now);
}

// --- the whole ------------------------------------------------------------------------------------------------------

bool Pilot::holds_line() const {
  return state_ == State::kRunIn || state_ == State::kOnLine || state_ == State::kRunOut || state_ == State::kAwaitLine;
}

void Pilot::observe(SimTime now, const msg::Estimate& estimate) {
  const auto attitude = frames::attitude_of(frames::quaternion_of(estimate.enu_from_body));
  const runlines::Vec2 velocity(estimate.velocity_enu_mps[0], estimate.velocity_enu_mps[1]);
  const runlines::Vec2 place(estimate.position_enu_m[0], estimate.position_enu_m[1]);
  if (state_ == State::kOrbit && std::abs(guidance::outside_m(circle_, place)) < kOnCircle * circle_.radius_m) {
    to_sweep_rad_ -= guidance::swept_rad(circle_, here_.waypose.position_enu_m, place);
  }
  if (begun_) {
    station_.observe(velocity, attitude.heading_rad, command(now).speed_mps,
                     holds_line() || (keeps() && !approaching_));
  }
  position_enu_m_ = estimate.position_enu_m;
  cosine_of_tilt_ = std::cos(attitude.roll_rad) * std::cos(attitude.pitch_rad);
  here_ = {{place, attitude.heading_rad}, velocity.norm(), -estimate.position_enu_m[2]};
  if (!home_enu_m_) home_enu_m_ = mission_.home_enu_m.value_or(place);
  if (begun_ && drift_settle_s_ > 0.0 && holds_line()) {
    drift_enu_mps_ = guidance::learn_drift(drift_enu_mps_, velocity, attitude.heading_rad, period_s_, drift_settle_s_);
  }
  if (depth_.steers()) height_ = depth_.order(now, here_.depth_m);
  abort_monitor_.observe(now, height_.too_low);
}

/// What headway shortens: off the line counts too, for a vehicle may be carried past it sideways.
std::optional<double> Pilot::way_to_go_m() const {
  switch (state_) {
    case State::kAwaitLine:
    case State::kStandBy:
    case State::kAbort:
    case State::kDone: return std::nullopt;
    case State::kTurn: return turn_.length_m() - along_turn_m_;
    default: break;
  }
  if (keeps() && approaching_)
    return turn_.length_m() - along_turn_m_ + runlines::length_m(station_.way_up(speed_mps_));
  if (keeps() && station_.arrived()) return std::nullopt;
  const msg::MissionState reported = mission_state({});
  return reported.distance_to_go_m + std::abs(reported.cross_track_m);
}

void Pilot::take_altitude(const msg::Altitude& altitude) {
  if (begun_ && altitude.valid) {
    depth_.take_altitude(SimTime{altitude.stamp_ns}, altitude.range_m * cosine_of_tilt_, here_.depth_m);
  }
}

void Pilot::update(SimTime now, const msg::Estimate& estimate) {
  observe(now, estimate);
  if (!std::exchange(begun_, true)) begin_step(now);
  if (state_ != State::kDone && state_ != State::kAbort) given_up_ = abort_monitor_.why(now, estimate);
  if (!given_up_.empty()) state_ = State::kAbort;
  const auto goal = std::tuple(state_, step_, round_, piece_);
  switch (state_) {
    case State::kTurn:
      if (turn_done()) state_ = State::kRunIn;
      break;
    case State::kPass:
      if (turn_done()) begin_step(now);
      break;
    case State::kKeep: keep_place(now); break;
    case State::kOrbit:
      if (to_sweep_rad_ <= 0.0) begin_step(now);
      break;
    case State::kAwaitLine: await_line(); break;
    default: break;
  }
  if (holds_line() && state_ != State::kAwaitLine) follow_line(now);
  abort_monitor_.go(now, way_to_go_m(), goal != std::tuple(state_, step_, round_, piece_));
}

void Pilot::stand_by(SimTime now, const msg::Estimate& estimate) {
  observe(now, estimate);
  if (ended() || state_ == State::kAbort) return;
  if (state_ != State::kStandBy && !falls_back_) interrupted_ = state_;
  state_ = State::kStandBy;
  abort_monitor_.go(now, std::nullopt, true);
}

void Pilot::take_over(SimTime now, bool after_silence) {
  if (state_ != State::kStandBy) return;
  constexpr double kForEver_s = std::numeric_limits<double>::infinity();
  const WhenSilent act = after_silence ? mission_.when_silent : WhenSilent::kGoOn;
  falls_back_ = act != WhenSilent::kGoOn;
  begun_ = true;
  switch (act) {
    case WhenSilent::kGoOn: resume(now); break;
    case WhenSilent::kHold: begin(KeepPlace{std::nullopt, kForEver_s}, now); break;
    case WhenSilent::kHome: begin(KeepPlace{home_enu_m_, kForEver_s}, now); break;
    case WhenSilent::kSurface:
      given_up_ = "the pilot that steered fell silent";
      state_ = State::kAbort;
      break;
  }
}

/// Goes on with the mission where another pilot interrupted it.
void Pilot::resume(SimTime now) {
  if (step_ == 0) return begin_step(now);
  state_ = interrupted_;
  switch (state_) {
    case State::kTurn:
    case State::kRunIn:
    case State::kOnLine:
    case State::kRunOut: head_for_line(); break;
    case State::kPass: head_for(goal_); break;
    case State::kKeep: begin(std::get<KeepPlace>(steps_[step_ - 1]), now); break;
    default: break;
  }
}

bool Pilot::ended() const {
  return state_ == State::kDone || (state_ == State::kAbort && (!depth_.steers() || here_.depth_m <= kSurfaced_m));
}

double Pilot::heading_for_rad(double course_rad, double speed_mps) const {
  return guidance::heading_for_course_rad(course_rad, speed_mps, drift());
}

/// Heading and speed of each state.
msg::Guidance Pilot::steer() const {
  const runlines::Vec2& place = here_.waypose.position_enu_m;
  msg::Guidance guidance;
  guidance.heading_grid_rad = frames::wrap_two_pi(here_.waypose.heading_rad);
  guidance.speed_mps = speed_mps_;
  switch (keeps() && approaching_ ? State::kTurn : state_) {
    case State::kTurn:
    case State::kPass: {  // steer as the path will bend when the command takes effect
      const double course_rad = runlines::follow_heading_rad(turn_, place, along_turn_m_, gains().lookahead_m) +
                                turn_.at(along_turn_m_ + here_.speed_mps * kLag_s).heading_rad -
                                turn_.at(along_turn_m_).heading_rad;
      guidance.speed_mps = turn_speed_mps();
      guidance.heading_grid_rad = heading_for_rad(course_rad, guidance.speed_mps);
      break;
    }
    case State::kRunIn:
    case State::kOnLine:
    case State::kRunOut:
    case State::kAwaitLine: {
      const double off_m = runlines::line_position(line(), place).cross_track_m;
      const double course_rad =
          runlines::heading_rad(line()) + guidance::course_offset_rad(gains(), off_m, integral_s_);
      guidance.heading_grid_rad = heading_for_rad(course_rad, speed_mps_);
      break;
    }
    case State::kOrbit: {  // on the circle the heading turns by speed / radius while the command is under way
      const double bend_rad = (circle_.clockwise ? 1.0 : -1.0) * here_.speed_mps * kLag_s / circle_.radius_m;
      guidance.heading_grid_rad =
          heading_for_rad(guidance::circle_course_rad(circle_, place, kCircleGain) + bend_rad, speed_mps_);
      break;
    }
    case State::kKeep: {
      const auto steering = station_.steer(here_.waypose, speed_mps_);
      guidance.heading_grid_rad = steering.heading_rad;
      guidance.speed_mps = steering.speed_mps;
      break;
    }
    case State::kStandBy: guidance.speed_mps = here_.speed_mps; break;
    case State::kAbort:
      if (ended()) guidance.speed_mps = 0.0;
      break;
    case State::kDone:
      if (!pieces_.empty()) guidance.heading_grid_rad = runlines::heading_rad(line());
      guidance.speed_mps = 0.0;
      break;
  }
  return guidance;
}

msg::Guidance Pilot::command(SimTime now) const {
  msg::Guidance guidance = steer();
  guidance.stamp_ns = now.count();
  if (state_ == State::kStandBy) return guidance;
  if (depth_.steers()) guidance.depth_m = state_ == State::kAbort ? 0.0 : height_.depth_m;
  if (height_.too_low && state_ != State::kAbort) guidance.speed_mps *= kSlowestClimb;
  return guidance;
}

msg::MissionState Pilot::mission_state(SimTime now) const {
  const runlines::Vec2& place = here_.waypose.position_enu_m;
  msg::MissionState mission;
  mission.stamp_ns = now.count();
  mission.state = name_of(state_);
  mission.line = line_ - (state_ == State::kTurn ? 1 : 0);
  mission.line_count = line_count_;
  if (holds_line()) mission.line_name = line_name_;
  if (state_ == State::kKeep) {
    mission.distance_to_go_m = (station_.place_enu_m() - place).norm();
  } else if (state_ == State::kOrbit) {
    mission.cross_track_m = (circle_.clockwise ? -1.0 : 1.0) * guidance::outside_m(circle_, place);
    mission.distance_to_go_m = to_sweep_rad_ * circle_.radius_m;
  } else if (state_ == State::kPass) {
    mission.distance_to_go_m = turn_.length_m() - along_turn_m_;
  } else if (!pieces_.empty()) {
    const auto at = runlines::line_position(line(), place);
    mission.cross_track_m = at.cross_track_m;
    mission.distance_to_go_m = to_go_m(at.along_m);
  }
  return mission;
}

}  // namespace ensonify
