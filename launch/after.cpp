#include "launch/after.h"

#include <fmt/format.h>

#include <csignal>
#include <cstdio>

#include "launch/child.h"
#include "launch/signals.h"

namespace ensonify::launcher {

int run_to_end(const Command& command) {
  Signals signals;
  Child child(command);
  bool interrupted = false;
  while (child.running()) {
    signals.wait(std::chrono::milliseconds(-1));
    if (signals.take().interrupts > 0) {
      child.send(interrupted ? SIGKILL : SIGTERM);
      interrupted = true;
    }
    reap_into(child);
  }
  if (interrupted) {
    return kExitInterrupted;
  }
  const Ending ending = *child.ending();
  const bool ours = ending.signal == 0 && ending.exit_code <= kExitDiffer;
  return ours ? ending.exit_code : int{kExitDied};
}

int run_after(const Launch& launch, const RunPlaces& places, bool output_to_error) {
  std::vector<Command> commands;
  for (const auto& step : launch.after) {
    commands.push_back(after_command(step, places));
    commands.back().output_to_error = output_to_error;
  }
  for (std::size_t i = 0; i < commands.size(); ++i) {
    if (const int code = run_to_end(commands[i]); code != kExitOk) {
      std::string words;
      for (const auto& word : launch.after[i]) {
        words += (words.empty() ? "" : " ") + word;
      }
      fmt::print(stderr, "ensonify run: after: `{}` ended with exit code {}\n", words, code);
      return code;
    }
  }
  return kExitOk;
}

}  // namespace ensonify::launcher
