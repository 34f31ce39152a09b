#include "launch/verdict.h"

#include <algorithm>
#include <csignal>
#include <cstring>

namespace ensonify::launcher {

void Verdict::fault(Fault fault) {
  if (!first_) {
    first_ = std::move(fault);
  }
}

void Verdict::assertion_failed(const std::string& message) {
  if (!failed_) {
    failed_ = Fault{kExitAssertionFailed, "expect", message};
  }
}

void Verdict::interrupted() { fault({kExitInterrupted, "", "interrupted"}); }

std::optional<Fault> Verdict::cause() const { return first_ ? first_ : failed_; }

int Verdict::code() const { return cause() ? cause()->code : kExitOk; }

std::string text_of(const Ending& ending) {
  return ending.signal != 0 ? "signal " + std::to_string(ending.signal) + " (" + ::strsignal(ending.signal) + ")"
                            : "exit code " + std::to_string(ending.exit_code);
}

std::optional<Fault> fault_of(const std::string& process, bool native, const Ending& ending) {
  if (ending.signal != 0) {
    return Fault{kExitDied, process, "was killed by " + text_of(ending)};
  }
  const int code = ending.exit_code;
  if (code == kExitOk) {
    return std::nullopt;
  }
  const bool reported = native ? (code >= kExitUserError && code <= kExitDiffer) || (code == 1 && process == "expect")
                               : code == kExitUserError || code == kExitDataLost;
  static const char* const kMeanings[] = {"",        "assertions failed", "refused its files or arguments", "died",
                                          "stalled", "lost data",         "found runs that differ"};
  const std::string meaning = reported ? kMeanings[code] : "died";
  return Fault{reported ? code : int{kExitDied}, process, meaning + " (" + text_of(ending) + ")"};
}

Fault most_significant(const std::vector<Fault>& faults) {
  const auto weight = [](const Fault& fault) {
    return fault.message.starts_with("was killed by signal") ? 0 : fault.culprit == "clock" ? 1 : 2;
  };
  return *std::min_element(faults.begin(), faults.end(),
                           [&](const Fault& a, const Fault& b) { return weight(a) < weight(b); });
}

}  // namespace ensonify::launcher
