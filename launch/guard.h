#pragma once

#include <sys/types.h>

#include <string>

namespace ensonify::launcher {

/// Leaves nothing behind when the launcher is killed with SIGKILL: a process that holds the read end of a pipe. When
/// the launcher is gone without having said so, it ends the process groups registered with it (SIGTERM, a second later
/// SIGKILL) and removes the run directory.
class Guard {
 public:
  /// Start it before any thread. It inherits the run directory's lock and so keeps it until it is through.
  explicit Guard(const std::string& run_dir);
  /// All is well: the guard leaves without doing anything.
  ~Guard();
  Guard(const Guard&) = delete;
  Guard& operator=(const Guard&) = delete;

  void watch(pid_t group);
  void forget(pid_t group);
  pid_t pid() const { return pid_; }

 private:
  void notify(pid_t value) const;

  pid_t pid_ = -1;
  int write_fd_ = -1;
};

}  // namespace ensonify::launcher
