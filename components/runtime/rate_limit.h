#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string>

#include "components/runtime/sim_time.h"

namespace ensonify {

/// A port that declares no rate publishes at most at 10 Hz on average.
constexpr Rate stated_rate(Rate declared) { return declared.num > 0 ? declared : Rate{10, 1}; }
constexpr SimTime period_of(Rate declared) { return event_time(1, stated_rate(declared)); }

/// Holds a topic to its declared rate in sim time: at most what one second of it brings and 2 more at once.
class RateLimit {
 public:
  explicit RateLimit(Rate declared) : hz_(stated_rate(declared).hz()), room_(most_at_once()) {}

  /// Takes `messages` published up to time `t`, which never goes back; false when they are too many.
  bool take(std::uint64_t messages, SimTime t) {
    room_ += hz_ * seconds(t - at_);
    at_ = t;
    if (static_cast<double>(messages) > room_) return false;
    room_ = std::min(most_at_once(), room_ - static_cast<double>(messages));
    return true;
  }

  /// What is allowed, for messages.
  std::string text() const { return fmt::format("more than {:g} Hz with {:g} at once", hz_, most_at_once()); }

 private:
  double most_at_once() const { return hz_ + 2.0; }

  double hz_;
  double room_;
  SimTime at_{0};
};

}  // namespace ensonify
