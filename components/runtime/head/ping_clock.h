#pragma once

#include "components/runtime/sim_time.h"

namespace ensonify {

/// How fast a head pings, and how long it takes from the last echo to the published ping.
struct PingTiming {
  Rate rate;             // at most
  SimTime dead_time{0};  // between the end of listening and the next transmission, at least
  SimTime processing_latency{0};
};

/// When a head may transmit: on the beat of its ping rate as long as pings fit into the beat; a ping that listens
/// longer moves the beat. Times are computed from counts, never summed.
class PingClock {
 public:
  PingClock(Rate rate, SimTime dead_time) : rate_(rate), dead_time_(dead_time) {}

  /// The next transmission.
  SimTime next() const { return next_; }

  /// Another beat, counted from next() on.
  void set_rate(Rate rate) {
    if (rate == rate_) return;
    rate_ = rate;
    restart(next_);
  }

  /// The head has transmitted at next() and listens for this long.
  void transmitted(SimTime listening) {
    const SimTime free = next_ + listening + dead_time_;
    advance();
    if (next_ < free) restart(free);
  }
  /// The head let a beat pass without transmitting.
  void skipped() { advance(); }

 private:
  void advance() { next_ = event_time(++beat_, rate_, phase_); }
  void restart(SimTime phase) {
    phase_ = next_ = phase;
    beat_ = 0;
  }

  Rate rate_;
  SimTime dead_time_;
  SimTime phase_{0};
  std::int64_t beat_ = 0;
  SimTime next_{0};
};

}  // namespace ensonify
