#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace ensonify::msg {

struct Counter {
  std::string name;
  std::int64_t count = 0;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("name", "", "name of what is counted", self.name);
    visit("count", "1", "number of times since the start", self.count);
  }
};

struct Health {
  static constexpr const char* kType = "health/1";
  static constexpr const char* kAbout =
      "How a process is doing, in sim time: published when it changes. Wall-clock facts are the clock's.";
  std::int64_t stamp_ns = 0;
  std::string state = "ok";
  std::string message;
  std::vector<Counter> counters;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("stamp_ns", "ns", "time of the report, sim time", self.stamp_ns);
    visit("state", "", "ok, degraded or failed", self.state);
    visit("message", "", "why, in one line", self.message);
    visit("counters", "", "counts of what happened", self.counters);
  }
};

}  // namespace ensonify::msg
