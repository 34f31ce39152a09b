#pragma once

#include <optional>
#include <string>
#include <vector>

#include "components/errors/exit_error.h"

namespace ensonify::launcher {

/// Something that went wrong in a run.
struct Fault {
  int code = kExitDied;
  std::string culprit;  // process name
  std::string message;
};

/// Decides a run's exit code: the first fault wins; a failed assertion (1) counts only when there was no fault;
/// Ctrl-C (130) only when there was neither before it.
class Verdict {
 public:
  void fault(Fault fault);
  void assertion_failed(const std::string& message);
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
/// other failure (an uncaught exception exits with 1) is a death. `expect` alone may say 1, `assertions failed`.
std::optional<Fault> fault_of(const std::string& process, bool native, const Ending& ending);

/// The fault that the others followed from, when several were noticed at once: a death by signal, then the clock's
/// word, then the first in the list. Precondition: not empty.
Fault most_significant(const std::vector<Fault>& faults);

}  // namespace ensonify::launcher
