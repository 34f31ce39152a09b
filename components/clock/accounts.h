#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "components/runtime/sim_time.h"

namespace ensonify::clock {

/// Cost of each participant in wall time, and number of times the run was late by it.
struct Account {
  std::string name;
  std::int64_t pid = 0;
  std::uint64_t grants = 0;
  std::int64_t cost_ns = 0;       // wall time inside its events
  std::uint64_t late_events = 0;  // grants it finished last, more than kLateAfter behind the paced time
  SimTime worst_lateness{0};
};

/// A run is late when sim time stands this far behind paced time.
inline constexpr SimTime kLateAfter = std::chrono::milliseconds(100);

/// The run as a whole.
struct Summary {
  std::string state = "connecting";  // connecting, running, paused, done, failed
  SimTime reached{0};
  std::optional<SimTime> end;
  double wall_s = 0.0;  // since time started
  std::optional<double> rate;
  std::uint64_t slips = 0;
  SimTime slipped{0};
  int exit_code = 0;
  std::string culprit;
  std::string message;
};

}  // namespace ensonify::clock
