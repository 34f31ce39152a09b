#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "components/autopilot/abort_monitor.h"
#include "components/autopilot/config.h"
#include "components/autopilot/depth_keeper.h"
#include "components/autopilot/station_keeper.h"
#include "components/runtime/sim_time.h"
#include "kernels/vehicle/guidance/laws.h"
#include "kernels/vehicle/runlines/runline.h"
#include "messages/mission.h"
#include "messages/motion.h"
#include "messages/navigation.h"
#include "messages/sonar.h"

namespace ensonify {

/// Runs a mission's steps in order by what navigation estimates. Each line is reached by the shortest way that the
/// turning circle allows, ending at the run-in; lines are held by integral line-of-sight guidance on a course that the
/// drift learned so far makes good.
class Pilot {
 public:
  enum class State { kTurn, kRunIn, kOnLine, kRunOut, kPass, kKeep, kOrbit, kAwaitLine, kStandBy, kAbort, kDone };

  Pilot(const AutopilotConfig& config, std::vector<MissionStep> steps);

  void take_altitude(const msg::Altitude& altitude);
  /// The line that an adaptive survey is to run next; taken when its number is the one awaited.
  void offer(const msg::NextLine& line) { offered_ = line; }

  /// Evaluates where the vehicle is and moves on through the states; then command() and mission_state() give the
  /// outcome.
  void update(SimTime now, const msg::Estimate& estimate);

  /// In the place of update() while another pilot steers.
  void stand_by(SimTime now, const msg::Estimate& estimate);
  /// The vehicle is this pilot's again; before update(). After one that fell silent the mission says what comes;
  /// otherwise it goes on: a line is run again from the beginning of the piece that was being run.
  void take_over(SimTime now, bool after_silence);

  State state() const { return state_; }
  /// Nothing is left to do: the mission is done, or given up with the vehicle at the surface.
  bool ended() const;
  /// Reason that the mission has been given up; empty: it has not.
  const std::string& given_up() const { return given_up_; }
  /// Whether the goal has not come nearer for a tenth of the patience.
  bool held_up(SimTime now) const { return abort_monitor_.held_up(now); }
  /// Whether no bottom has been detected of late that an altitude or the obstacle floor could be kept from.
  bool bottom_lost(SimTime now) const { return depth_.bottom_lost(now); }
  msg::Guidance command(SimTime now) const;
  msg::MissionState mission_state(SimTime now) const;

  /// Requests of steps since the last call: settings by head, and marks.
  std::vector<std::pair<std::string, msg::SonarSettings>> take_settings() { return std::exchange(settings_, {}); }
  std::vector<msg::Mark> take_marks() { return std::exchange(marks_, {}); }

 private:
  struct Place {
    runlines::Waypose waypose;
    double speed_mps = 0.0;  // over ground
    double depth_m = 0.0;
  };

  // --- steps
  void begin_step(SimTime now);
  void resume(SimTime now);
  void begin(const FollowLine& line, SimTime now);
  void begin(const PassPlace& pass, SimTime now);
  void begin(const KeepPlace& keep, SimTime now);
  void begin(const FollowOrbit& orbit, SimTime now);
  void begin(const GoAt& go, SimTime now);
  void begin(const SetSonar& sonar, SimTime now);
  void begin(const SetMark& mark, SimTime now);
  void await_line();

  // --- lines and turns
  const runlines::Runline& line() const { return pieces_[piece_]; }
  double to_go_m(double along_m) const;
  bool lined_up() const;
  void head_for_line();
  void head_for(const runlines::Waypose& goal);
  bool turn_done();
  void follow_line(SimTime now);
  void keep_place(SimTime now);
  double switch_before_end_m() const;

  // --- steering
  void observe(SimTime now, const msg::Estimate& estimate);
  std::optional<double> way_to_go_m() const;
  guidance::LineGains gains() const;
  bool holds_line() const;
  bool keeps() const { return state_ == State::kKeep; }
  /// Motion of the water about the vehicle, as far as the state needs it.
  const runlines::Vec2& drift() const { return keeps() ? station_.current_enu_mps() : drift_enu_mps_; }
  double planned_radius_m() const;
  double turn_speed_mps() const { return speed_mps_ * turn_speed_fraction_; }
  double heading_for_rad(double course_rad, double speed_mps) const;
  msg::Guidance steer() const;

  // What is to be run.
  Mission mission_;
  motion::Limits limits_;
  double lookahead_radii_, turn_margin_, turn_speed_fraction_, drift_settle_s_, period_s_;
  std::vector<MissionStep> steps_;
  std::size_t step_ = 0;  // the next to begin
  int round_ = 0;
  std::int64_t line_count_ = 0;

  // Where the vehicle is in it.
  State state_ = State::kTurn;
  State interrupted_ = State::kTurn;  // of the mission, when another pilot began to steer
  bool falls_back_ = false;           // does what `when_silent` says in the mission's place
  bool begun_ = false;
  std::int64_t line_ = -1;  // number of the line run or headed for
  std::string line_name_;
  std::vector<runlines::Runline> pieces_;
  std::size_t piece_ = 0;
  runlines::Turn turn_;
  runlines::Waypose goal_;
  double along_turn_m_ = 0.0;
  StationKeeper station_;
  bool approaching_ = false;  // a station: the turn before the last way to it is run
  guidance::Circle circle_;
  double to_sweep_rad_ = 0.0;
  std::optional<msg::NextLine> offered_;

  // How it goes.
  Place here_;
  double speed_mps_;
  double integral_s_ = 0.0;
  runlines::Vec2 drift_enu_mps_ = runlines::Vec2::Zero();
  double cosine_of_tilt_ = 1.0;
  DepthKeeper depth_;
  guidance::HeightOrder height_;
  AbortMonitor abort_monitor_;
  std::string given_up_;

  std::vector<std::pair<std::string, msg::SonarSettings>> settings_;
  std::vector<msg::Mark> marks_;
  std::array<double, 3> position_enu_m_{};
  std::optional<runlines::Vec2> home_enu_m_;
};

}  // namespace ensonify
