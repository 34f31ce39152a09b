#pragma once

#include <cstddef>
#include <vector>

#include "components/runtime/sim_time.h"

namespace ensonify {

/// Decides how far each participant may run. Conservative: nobody is ever let past a message that may still come.
///
/// The horizon of p is the smallest of: next(u) - 1 ns over plain inputs from u, next(u) + d - 1 ns over inputs delayed
/// by d, next(c) + window over consumers c of p, next(f) + kFinishMargin over those who may end the run, the cap
/// (pacing, pause, step), the end, and where p is to stop. Pure logic: the clock process drives it with sockets and
/// wall time, the in-process runner with function calls.
class Conductor {
 public:
  struct Edge {
    std::size_t from = 0;
    std::size_t to = 0;
    SimTime delay{0};
  };
  struct Grant {
    std::size_t participant = 0;
    SimTime horizon{0};
  };

  Conductor(std::size_t participants, std::vector<Edge> edges, std::vector<bool> may_finish, SimTime window);

  /// No event after this time runs, from now on. May be lowered, never below what has been granted.
  void end_at(SimTime end);
  /// `participant` runs no event at or after this time, from now on. Never below what it has been granted.
  void stop_before(std::size_t participant, SimTime t);
  /// Ends as soon as everybody has reached the furthest time granted so far.
  void end_now();
  /// Pacing, pause and step: nobody acts after `cap`. Lowering it takes nothing back.
  void set_cap(SimTime cap) { cap_ = cap; }

  /// Participants that may run now and were not running. Marks them as running.
  std::vector<Grant> grants();
  /// `participant` has run its grant and promises to publish nothing before `next`.
  void done(std::size_t participant, SimTime next);

  /// Everybody is idle and has no event left before or at the end.
  bool finished() const;
  /// Somebody is running.
  bool busy() const;

  /// Time of the earliest event not yet done: sim time has reached it.
  SimTime now() const;
  SimTime next(std::size_t participant) const { return state_[participant].next; }
  bool running(std::size_t participant) const { return state_[participant].running; }
  /// It has come to where it is to stop.
  bool stopped(std::size_t participant) const;
  SimTime granted(std::size_t participant) const { return state_[participant].granted; }
  SimTime end() const { return end_; }
  SimTime cap() const { return cap_; }
  /// Earliest event that waits for the cap alone, kNever if none does: when pacing has to check again.
  SimTime next_capped() const;
  /// Those whose promise holds `participant` back now: for stall reports.
  std::vector<std::size_t> waits_for(std::size_t participant) const;

 private:
  struct State {
    SimTime next{0};
    SimTime granted{-1};
    SimTime stop = kNever;
    bool running = false;
  };
  SimTime uncapped_horizon(std::size_t participant) const;

  std::vector<Edge> edges_;
  std::vector<bool> may_finish_;
  SimTime window_;
  SimTime end_ = kNever;
  SimTime cap_ = kNever;
  std::vector<State> state_;
};

}  // namespace ensonify
