#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "launch/file/launch_file.h"
#include "scenarios/world/world.h"

namespace ensonify::launcher {

/// Length of the run in sim time: its hard end, else what its runlines take at mission speed with their turns;
/// nothing when neither is known.
std::optional<double> expected_duration_s(const Launch& launch, const World& world);

/// "t 123.4 s  12.3x real time  about 1 min 20 s left  RUNNING". Times in s; the rate is of the whole run.
std::string progress_text(double sim_s, double wall_s, std::optional<double> duration_s, const std::string& state);

/// Shows one line of progress that overwrites itself on a terminal; into a file or pipe, a line every ten seconds.
class Progress {
 public:
  Progress(bool quiet, std::optional<double> duration_s);
  void show(double sim_s, double wall_s, const std::string& state);
  /// Ends the line, so that what follows begins a new one.
  void finish();

 private:
  bool quiet_;
  bool terminal_;
  std::optional<double> duration_s_;
  bool shown_ = false;
  double next_line_s_ = 10.0;
};

}  // namespace ensonify::launcher
