#pragma once

#include <cstddef>
#include <vector>

#include "components/autopilot/config.h"
#include "components/runtime/sim_time.h"
#include "kernels/navigation/turn.h"
#include "messages/motion.h"
#include "messages/navigation.h"

namespace ensonify {

/// Flies survey lines in order by what navigation estimates. Each line is reached by the shortest way that the turning
/// circle allows, ending at the run-in; run-in and line are held by line-of-sight guidance.
class Pilot {
 public:
  enum class State { kTurn, kRunIn, kOnLine, kDone };

  Pilot(const AutopilotConfig& config, std::vector<navigation::Runline> lines);

  /// Looks where the vehicle is and moves on through the states; then command() and mission_state() tell the outcome.
  void update(const msg::Estimate& estimate);

  State state() const { return state_; }
  msg::Guidance command(SimTime now) const;
  msg::MissionState mission_state(SimTime now) const;

 private:
  struct Place {
    navigation::Waypose waypose;
    double speed_mps = 0.0;
  };

  const navigation::Runline& line() const { return lines_[line_]; }
  bool lined_up() const;
  void head_for_line();
  void follow_turn();
  double lookahead_m() const;

  double speed_mps_, turn_speed_mps_, run_in_m_;
  double turning_radius_m_, planned_radius_m_, lookahead_radii_;
  std::vector<navigation::Runline> lines_;
  std::size_t line_ = 0;  // flown or headed for
  State state_ = State::kTurn;
  bool begun_ = false;
  Place here_;
  navigation::Turn turn_;
  double along_turn_m_ = 0.0;
};

}  // namespace ensonify
