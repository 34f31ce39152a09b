#pragma once

#include <chrono>
#include <cstdint>
#include <deque>

#include "components/runtime/sim_time.h"

namespace ensonify::topic_tool {

using WallTime = std::chrono::steady_clock::time_point;

/// Mean and standard deviation of the time between two messages, s.
struct Interval {
  double mean_s = 0.0;
  double jitter_s = 0.0;  // standard deviation
};

/// Traffic of a topic over the last messages seen. Rates count what was published, not only what we were given: the
/// live plane drops, and the sequence numbers say how much.
struct Traffic {
  std::uint64_t received = 0;  // since the start
  std::uint64_t dropped = 0;   // since the start: published, but not for us
  double wall_hz = 0.0;        // published per wall second
  double sim_hz = 0.0;         // published per sim second
  Interval wall;               // between messages that followed one another
  Interval sim;
  double mean_bytes = 0.0;
  std::size_t min_bytes = 0;
  std::size_t max_bytes = 0;
  double wall_bytes_per_s = 0.0;  // published
  double sim_bytes_per_s = 0.0;
};

/// Measures one topic.
class Meter {
 public:
  /// `window`: how many messages, at least 2, the rates are taken over.
  explicit Meter(std::size_t window) : window_(window) {}

  void add(WallTime arrived, SimTime t_sim, std::uint64_t seq, std::size_t bytes);
  /// Rates are zero until two messages have come.
  Traffic traffic() const;

 private:
  struct Arrival {
    WallTime wall;
    SimTime sim;
    std::uint64_t seq;
    std::size_t bytes;
  };
  std::size_t window_;
  std::deque<Arrival> last_;
  std::uint64_t received_ = 0;
  std::uint64_t dropped_ = 0;
};

}  // namespace ensonify::topic_tool
