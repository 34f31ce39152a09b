#pragma once

#include <stdexcept>
#include <string>

namespace ensonify {

/// Exit codes of every program (launch/README.md). The first fault wins.
enum ExitCode {
  kExitOk = 0,
  kExitAssertionFailed = 1,
  kExitUserError = 2,  // files or arguments are wrong
  kExitDied = 3,       // a process died, or a mistake of ours
  kExitStall = 4,
  kExitDataLost = 5,  // a message or a record could not be kept
  kExitDiffer = 6,
  kExitInterrupted = 130
};

/// An error that decides the program's exit code. The text is what the user reads: place, cause, what is allowed.
struct ExitError : std::runtime_error {
  ExitError(ExitCode exit_code, const std::string& text) : std::runtime_error(text), code(exit_code) {}
  ExitCode code;
};

/// The user's files or arguments are wrong.
struct UserError : ExitError {
  explicit UserError(const std::string& text) : ExitError(kExitUserError, text) {}
};

/// A message or a record could not be kept.
struct DataLost : ExitError {
  explicit DataLost(const std::string& text) : ExitError(kExitDataLost, text) {}
};

/// What another process sent cannot be used: it is to blame, not the process that noticed.
struct PeerError : ExitError {
  PeerError(ExitCode exit_code, const std::string& process, const std::string& text)
      : ExitError(exit_code, text), culprit(process) {}
  std::string culprit;
};

}  // namespace ensonify
