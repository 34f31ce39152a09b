#pragma once

#include <sys/types.h>

#include <chrono>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "components/errors/exit_error.h"

namespace ensonify::launcher {

/// SIGCHLD, SIGINT and SIGTERM as events to wait for. They stay blocked as long as this lives.
class Signals {
 public:
  Signals();
  ~Signals();
  Signals(const Signals&) = delete;
  Signals& operator=(const Signals&) = delete;

  /// Bytes that have arrived since the last call.
  struct Arrived {
    bool child = false;
    int interrupts = 0;
  };
  Arrived take();

  /// True when something arrived within `patience`.
  bool wait(std::chrono::milliseconds patience) const;
  int fd() const { return fd_; }

 private:
  int fd_ = -1;
};

/// Waits until `file` exists in a folder that is being watched, without polling.
class FileWatch {
 public:
  explicit FileWatch(const std::string& folder);
  ~FileWatch();
  FileWatch(const FileWatch&) = delete;
  FileWatch& operator=(const FileWatch&) = delete;

  /// Waits for a change in the folder or a signal, whichever comes first.
  void wait(const Signals& signals, std::chrono::milliseconds patience);

 private:
  int fd_ = -1;
};

/// Something that went wrong in a run.
struct Fault {
  int code = kExitDied;
  std::string culprit;  // process name
  std::string message;
  bool by_clock = false;  // the clock said so, whoever the culprit is
};

/// Decides a run's exit code: the first fault wins; a failed assertion (1) counts only when there was no fault;
/// Ctrl-C (130) only when there was neither before it.
class Verdict {
 public:
  void fault(Fault fault);
  void assertion_failed(const std::string& process, const std::string& message);
  void interrupted();

  int code() const;
  bool ended() const { return first_.has_value(); }
  /// Fault that decided; nothing when all went well.
  std::optional<Fault> cause() const;

 private:
  std::optional<Fault> first_;
  std::optional<Fault> failed_;
};

/// Ending of a child.
struct Ending {
  int exit_code = 0;  // when signal is 0
  int signal = 0;
};

/// "exit code 3", "signal 9 (Killed)".
std::string text_of(const Ending& ending);

/// Meaning of an ending. Native programs speak our exit codes; of a foreign one 2 and 5 are taken at their word, every
/// other failure (an uncaught exception exits with 1) is a death. A native 1 is what the run was to show and did not:
/// an assertion of `expect`, a mission that was given up.
std::optional<Fault> fault_of(const std::string& process, bool native, const Ending& ending);

/// The fault that the others followed from, when several were noticed at once: a death by signal, then the clock's
/// word, then the first in the list. Precondition: not empty.
Fault most_significant(const std::vector<Fault>& faults);

class Signals;

/// Command to start.
struct Command {
  std::vector<std::string> argv;           // argv[0] is the path of the program
  std::map<std::string, std::string> env;  // added to our own environment
  std::vector<int> cpus;                   // empty: any
  std::string log_file;                    // standard output and error; "": ours
  std::string error_file;                  // standard error apart; "": together with the output
  bool output_to_error = false;            // without a log file: standard output goes where our standard error goes
  int keep_fd = -1;                        // a descriptor that the child inherits
};

/// The path of a program as a shell would find it ("" when there is none).
std::string find_program(const std::string& name);

/// A process of its own process group that is sent SIGTERM when we die.
class Child {
 public:
  /// Throws UserError when it cannot be started.
  explicit Child(const Command& command);

  pid_t pid() const { return pid_; }
  /// To its whole group. Nothing when it has ended.
  void send(int signal) const;

  /// Called with what wait4 said.
  void ended(int wait_status, long max_rss_kib, double cpu_s);
  bool running() const { return !ending_.has_value(); }
  const std::optional<Ending>& ending() const { return ending_; }
  long max_rss_kib() const { return max_rss_kib_; }
  double cpu_s() const { return cpu_s_; }

 private:
  pid_t pid_ = -1;
  std::optional<Ending> ending_;
  long max_rss_kib_ = 0;
  double cpu_s_ = 0.0;
};

/// A child that has ended since the last call, or nothing. What was left of its process group is killed.
struct Reaped {
  pid_t pid = -1;
  int wait_status = 0;
  long max_rss_kib = 0;
  double cpu_s = 0.0;
};
std::optional<Reaped> reap();

/// Reaps all that have ended, and says whether `child` is among them.
void reap_into(Child& child);

/// Waits until `child` ends and says how. One of whose end nothing is received within `patience`, or before an
/// interrupt, is killed: nothing. `signals` has lived since before the child was started, and what it has received
/// already counts.
std::optional<Ending> end_within(Child& child, Signals& signals, std::chrono::milliseconds patience);

/// The last `lines` lines of a text file, without the line end of the last; "" when it cannot be read.
std::string tail(const std::string& file, int lines);

}  // namespace ensonify::launcher
