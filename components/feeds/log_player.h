#pragma once

#include <fstream>
#include <optional>
#include <string>

#include "components/runtime/sim_time.h"

namespace ensonify {

/// A log of NMEA lines, played in sim time by the times of its own sentences: whatever the rate of the run, each line
/// comes when as much sim time has passed as the log's clock has. What stands before a line's `$`, such as a logger's
/// stamp, is left out. Sentences without a time come with the last one that has one; where the log's time goes back or
/// leaps by more than an hour, the log goes on at once from there.
class LogPlayer {
 public:
  /// Throws UserError when the file cannot be read, or no sentence of it has a time.
  explicit LogPlayer(const std::string& path);

  struct Line {
    std::string text;
    SimTime arrival;
  };
  /// The next line that has come by `now`; the first comes at the first call's `now`.
  std::optional<Line> take(SimTime now);

 private:
  void read_next();

  std::ifstream file_;
  std::optional<Line> next_;
  std::optional<double> time_of_day_s_;  // of the last line that has one
  SimTime time_{0};                      // when it came
};

}  // namespace ensonify
