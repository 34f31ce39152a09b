#include "tools/console/own_run.h"

#include <fmt/format.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "components/config/data_paths.h"
#include "components/errors/exit_error.h"

namespace ensonify::console {

namespace {

launcher::Command command_of(const RunOptions& options, const std::string& name) {
  launcher::Command command;
  command.argv = {program_folder() + "/ensonify-run", options.launch, "--name", name, "--out", options.out};
  for (const std::string& arg : options.args) command.argv.insert(command.argv.end(), {"--arg", arg});
  for (const std::string& set : options.sets) command.argv.insert(command.argv.end(), {"--set", set});
  if (options.free) command.argv.emplace_back("--free");
  if (options.rate > 0.0) command.argv.insert(command.argv.end(), {"--rate", fmt::format("{:.17g}", options.rate)});
  return command;
}

}  // namespace

OwnRun::OwnRun(const RunOptions& options)
    : name_(fmt::format("console-{}", ::getpid())), child_(command_of(options, name_)) {}

std::optional<int> OwnRun::exit_code() {
  if (child_.running()) {
    int status = 0;
    rusage used{};
    if (::wait4(child_.pid(), &status, WNOHANG, &used) != child_.pid()) return std::nullopt;
    child_.ended(status, used.ru_maxrss, 0.0);
  }
  const launcher::Ending& ending = *child_.ending();
  return ending.signal != 0 ? int{kExitDied} : ending.exit_code;
}

void OwnRun::interrupt() {
  if (child_.running()) child_.send(SIGINT);
}

int OwnRun::wait() {
  while (!exit_code()) ::usleep(20'000);
  return *exit_code();
}

}  // namespace ensonify::console
