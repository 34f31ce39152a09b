#pragma once

#include <chrono>

#include "components/runtime/sim_time.h"

namespace ensonify {

/// The run's time of arrivals, whose wall time is known. Events of a run in real time are never early, but some are
/// late by what else the machine does: the least late ones bind the two clocks. Where the run falls behind by more than
/// kMostLate it was stopped, or its rate is below 1: then the event itself does.
/// Real time starts when all have run their events at 0, so that those bind nothing.
class ArrivalClock {
 public:
  using Wall = std::chrono::steady_clock::time_point;
  static constexpr SimTime kMostLate = std::chrono::milliseconds(50);

  /// An event at the run's time `now` takes place at that wall time.
  void event(SimTime now, Wall wall);
  /// The run's time of an arrival; it may lie behind the event that is late.
  SimTime of(Wall arrival) const { return SimTime{arrival.time_since_epoch()} - ahead_; }

 private:
  bool bound_ = false;
  SimTime now_{0};    // the last event
  SimTime ahead_{0};  // wall time less the run's, where no event is late
};

}  // namespace ensonify
