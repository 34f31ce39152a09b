#pragma once

#include <optional>
#include <string>
#include <vector>

#include "launch/child.h"

namespace ensonify::console {

/// What `ensonify run` is given.
struct RunOptions {
  std::string launch;
  std::vector<std::string> args;
  std::vector<std::string> sets;
  std::string out = "out";
  double rate = 0.0;  // 0: as the launch file says
  bool free = false;
};

/// A run that this console has started: `ensonify run` in a process of its own, which outlives no console.
class OwnRun {
 public:
  /// Throws UserError when it cannot be started.
  explicit OwnRun(const RunOptions& options);

  /// The name by which it is found.
  const std::string& name() const { return name_; }
  /// Its exit code, once it has ended.
  std::optional<int> exit_code();
  /// As Ctrl-C would.
  void interrupt();
  /// Waits for its end.
  int wait();

 private:
  std::string name_;
  launcher::Child child_;
};

}  // namespace ensonify::console
