#pragma once

#include <sys/types.h>

#include <chrono>
#include <string>

#include "components/runtime/run_finder.h"

namespace ensonify::launcher {

/// A private folder (mode 0700) for one run's sockets: `$XDG_RUNTIME_DIR/ensonify/<id>`, or `/tmp/ensonify-<uid>/<id>`
/// when that variable is unset or its path leaves too little of a socket path's 107 bytes.
///
/// While a run lives, somebody holds a flock on `<folder>/lock`. Making a new one removes the folders of dead runs,
/// those whose lock is free; so two runs at once never see each other.
class RunDir {
 public:
  /// Throws UserError when no safe folder can be made, or when a live run has the same name.
  explicit RunDir(const AboutRun& about = {});
  /// Removes the folder.
  ~RunDir();
  RunDir(const RunDir&) = delete;
  RunDir& operator=(const RunDir&) = delete;

  const std::string& path() const { return path_; }
  std::string file(const std::string& name) const { return path_ + "/" + name; }
  /// Descriptor of the lock, for a child that shall keep the run alive when we die.
  int lock_fd() const { return lock_fd_; }

 private:
  std::string path_;
  int lock_fd_ = -1;
};

/// The folder of a run's results, made when it is missing and held while this lives: two runs that name one would mix
/// their records and logs. Processes that we fork and that do not become another program hold it too.
class OutFolder {
 public:
  /// Throws UserError when it cannot be made, or when another run holds it for longer than `patience`.
  explicit OutFolder(const std::string& path, std::chrono::milliseconds patience = {});
  ~OutFolder();
  OutFolder(const OutFolder&) = delete;
  OutFolder& operator=(const OutFolder&) = delete;

 private:
  int fd_ = -1;
};

/// The folder that holds all runs of this user, made when it is missing. Throws UserError.
std::string runs_folder();

/// Removes the folders of runs that nobody holds any more; returns how many. The caller need not lock anything.
int remove_dead_runs(const std::string& folder);

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
