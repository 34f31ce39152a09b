#pragma once

#include <optional>

#include "components/runtime/sim_time.h"
#include "kernels/vehicle/guidance/laws.h"
#include "kernels/vehicle/motion/kinematics.h"
#include "kernels/vehicle/runlines/runline.h"
#include "scenarios/world/mission.h"

namespace ensonify {

/// Keeps one place after another. A vehicle that only goes ahead stands in a current with its bow upstream, so that it
/// has to come from downstream: with the current astern it would be carried past its place while it turns. The current
/// is learned on straight ways, from the speed that the vehicle was commanded.
class StationKeeper {
 public:
  /// `settle_s` is the time constant of learning; 0: nothing is learned. Called every `period_s`.
  StationKeeper(const motion::Limits& limits, double lag_s, double settle_s, double period_s);

  /// `commanded_mps` is the speed last commanded; `straight`: no turn is run.
  void observe(const runlines::Vec2& velocity_enu_mps, double heading_rad, double commanded_mps, bool straight);

  /// `at_rest_enu_m` is kept where no place is given: where the vehicle comes to rest without turning back.
  void begin(const KeepPlace& keep, const runlines::Vec2& at_rest_enu_m);
  /// Whether a way to the place is to be chosen: at the beginning; because the current has turned out to be another one
  /// while the place is still far; or because the vehicle has lost the way up the stream. Not in a turn.
  bool asks_for_approach(const runlines::Waypose& here, double speed_mps) const;
  /// Chooses it: where the last, straight part begins, up the stream; nothing: here.
  std::optional<runlines::Waypose> approach(const runlines::Waypose& here, double speed_mps);
  /// That part.
  runlines::Runline way_up(double speed_mps) const;

  /// Counts the time at the place; true when it has been kept long enough. A turn that leads past the place does not
  /// count, but where the vehicle is to stay where it was the time runs from the beginning.
  bool kept(SimTime now, const runlines::Vec2& here_enu_m, bool in_turn);
  bool arrived() const { return kept_since_.has_value(); }
  guidance::Steering steer(const runlines::Waypose& here, double speed_mps) const;

  const runlines::Vec2& place_enu_m() const { return place_enu_m_; }
  const runlines::Vec2& current_enu_mps() const { return current_enu_mps_; }

 private:
  bool in_stream() const;
  guidance::StationRules rules(double speed_mps) const;

  motion::Limits limits_;
  double lag_s_, settle_s_, period_s_;
  runlines::Vec2 current_enu_mps_ = runlines::Vec2::Zero();
  double commanded_lately_mps_ = 0.0;

  KeepPlace keep_;
  runlines::Vec2 place_enu_m_ = runlines::Vec2::Zero();
  std::optional<runlines::Vec2> planned_for_enu_mps_;  // the current that the approach was chosen for
  std::optional<SimTime> kept_since_;
};

}  // namespace ensonify
