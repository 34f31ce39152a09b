#pragma once

#include <chrono>
#include <optional>

#include "components/runtime/sim_time.h"

namespace ensonify::clock {

using WallTime = std::chrono::steady_clock::time_point;

/// Wall time to sim time: how far the run may have come by now. Free running, paused and single step are caps too.
class Pacer {
 public:
  /// `rate` in sim seconds per wall second; nothing runs free.
  Pacer(std::optional<double> rate, SimTime slip_after) : rate_(rate), slip_after_(slip_after) {}

  /// From now on sim time follows wall time; called again, nothing. Before, the cap stands at 0: the first events take
  /// what they need to get ready.
  void start(WallTime now);
  /// Sim time is 0 again, and has to be started. The rate stands; a paused run waits there.
  void begin_again();

  /// The cap at a wall time: kNever when free running.
  SimTime cap(WallTime now) const;
  /// Time at which the cap reaches `t`; nothing when it never does by itself (paused) or there is no need to wait
  /// (free).
  std::optional<WallTime> when(SimTime t) const;

  /// Lateness of the run at sim time `reached`, in sim time; zero when free or paused.
  SimTime lateness(SimTime reached, WallTime now) const;
  /// Beyond `slip_after` the origin moves so that the run is on time again; returns by how much (zero: it did not).
  SimTime slip(SimTime reached, WallTime now);

  void set_rate(std::optional<double> rate, SimTime reached, WallTime now);
  void pause(SimTime reached, WallTime now);
  /// Pauses, and lets sim time advance to `until`.
  void step_to(SimTime until, SimTime reached, WallTime now);
  void resume(WallTime now);
  bool paused() const { return paused_; }
  std::optional<double> rate() const { return rate_; }

 private:
  std::optional<double> rate_;
  SimTime slip_after_;
  bool started_ = false;
  WallTime origin_wall_{};
  SimTime origin_sim_{0};
  bool paused_ = false;
  SimTime pause_cap_{0};
};

}  // namespace ensonify::clock
