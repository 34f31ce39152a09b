#pragma once

#include <cstdint>
#include <deque>
#include <optional>

namespace ensonify::logger {

/// Heave by time, as the motion sensor reports it, turned to positive down.
class Heave {
 public:
  void push(std::int64_t stamp_ns, double heave_up_m);
  /// On the straight line between its neighbours, at the ends the nearest; 0 while nothing is known.
  double down_m(std::int64_t stamp_ns) const;
  std::optional<std::int64_t> newest_ns() const;

 private:
  struct Sample {
    std::int64_t stamp_ns;
    double down_m;
  };
  std::deque<Sample> samples_;
};

}  // namespace ensonify::logger
