#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace ensonify::msg {

/// Cost of one participant in wall time.
struct Pace {
  std::string name;
  std::int64_t grants = 0;
  double cost_s = 0.0;
  std::int64_t late_events = 0;
  double worst_lateness_s = 0.0;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("name", "", "name of the process in the launch file", self.name);
    visit("grants", "1", "grants given to it", self.grants);
    visit("cost_s", "s", "wall time inside its events", self.cost_s);
    visit("late_events", "1", "grants that it finished last, the run being late", self.late_events);
    visit("worst_lateness_s", "s", "largest lateness charged to it, sim time", self.worst_lateness_s);
  }
};

struct ClockHealth {
  static constexpr const char* kType = "clock_health/1";
  static constexpr const char* kAbout =
      "How a run keeps its pace, about once a second of wall time. Wall-clock facts: on the live plane only, never "
      "recorded.";
  std::int64_t stamp_ns = 0;
  std::string state = "running";
  double wall_s = 0.0;
  double rate = 0.0;
  double rate_factor = 0.0;
  double lateness_s = 0.0;
  std::int64_t slips = 0;
  double slip_s = 0.0;
  std::vector<Pace> participants;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("stamp_ns", "ns", "sim time that all participants have reached", self.stamp_ns);
    visit("state", "", "running or paused", self.state);
    visit("wall_s", "s", "wall time since sim time started", self.wall_s);
    visit("rate", "1", "sim seconds per wall second asked for; 0: as fast as possible", self.rate);
    visit("rate_factor", "1", "sim seconds per wall second achieved since the report before", self.rate_factor);
    visit("lateness_s", "s", "time that the run stands behind paced time, sim time", self.lateness_s);
    visit("slips", "1", "number of times that lost time was given up (slip_after_s)", self.slips);
    visit("slip_s", "s", "sim time given up in all", self.slip_s);
    visit("participants", "", "participants by rank", self.participants);
  }
};

}  // namespace ensonify::msg
