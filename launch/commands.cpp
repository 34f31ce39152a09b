#include "launch/commands.h"

#include <fmt/format.h>
#include <sched.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "components/config/config_text.h"
#include "components/config/data_paths.h"
#include "components/errors/exit_error.h"
#include "components/runtime/bus/keys.h"
#include "launch/child.h"

namespace ensonify::launcher {

namespace {

namespace fs = std::filesystem;

std::string log_file(const RunPlaces& places, const std::string& name) { return places.out + "/log/" + name + ".log"; }

Command native(const std::string& program, const Launch& launch, const RunPlaces& places) {
  Command command;
  command.argv = {places.program_folder + "/ensonify-" + program};
  const auto arguments = to_arguments(launch.options);
  command.argv.insert(command.argv.end(), arguments.begin(), arguments.end());
  command.argv.insert(command.argv.end(), {"--run-dir", places.run_dir});
  return command;
}

/// `python3` from PATH; `examples/agent.py` from the working folder, the launch file's or the project's.
std::string resolved(const std::string& word, const Launch& launch) {
  std::error_code error;
  if (word.find('/') == std::string::npos || fs::exists(word, error)) {
    return word;
  }
  const std::string found = find_data(word, {fs::path(launch.file).parent_path().string()});
  return found.empty() ? word : found;
}

/// Our Python client, importable without being installed.
std::string python_path() {
  const char* given = std::getenv("PYTHONPATH");
  std::string path = given != nullptr ? given : "";
  const std::string client = find_data("clients/python", {});
  return client.empty() ? path : client + (path.empty() ? "" : ":" + path);
}

void check_cpus(const ProcessSpec& process) {
  cpu_set_t available;
  CPU_ZERO(&available);
  ::sched_getaffinity(0, sizeof available, &available);
  for (const int cpu : process.cpus) {
    if (cpu >= CPU_SETSIZE || !CPU_ISSET(static_cast<std::size_t>(cpu), &available)) {
      throw ConfigError({{process.place, "processes." + process.name + ".cpus",
                          "CPU " + std::to_string(cpu) + " is not available to this launcher"}});
    }
  }
}

}  // namespace

Command clock_command(const Launch& launch, const RunPlaces& places, const std::set<std::string>& hosted) {
  Command command = native(hosted.empty() ? "conductor" : "host", launch, places);
  for (const std::string& name : hosted) command.argv.insert(command.argv.end(), {"--host", name});
  command.log_file = log_file(places, "clock");
  return command;
}

Command process_command(const Launch& launch, const ProcessSpec& process, const RunPlaces& places,
                        const std::string& clock_endpoint) {
  Command command;
  if (process.argv.empty()) {
    command = native(process.component, launch, places);
    command.argv.insert(command.argv.end(), {"--name", process.name, "--clock", clock_endpoint});
  } else {
    for (const auto& word : process.argv) {
      command.argv.push_back(resolved(word, launch));
    }
    command.argv[0] = find_program(command.argv[0]);
    command.env = {{"ENSONIFY_CLOCK", clock_endpoint},
                   {"ENSONIFY_NAME", process.name},
                   {"ENSONIFY_RUN_DIR", places.run_dir},
                   {"ENSONIFY_OUT", places.out},
                   {"ENSONIFY_CONFIG", to_json(process.config.root)},
                   {"PYTHONPATH", python_path()},
                   {"PYTHONUNBUFFERED", "1"}};
    const bool has_keys = launch.clock.transport == ClockSettings::Transport::kTcp && launch.clock.keys;
    command.env["ENSONIFY_KEYS"] = has_keys ? places.run_dir + "/" + bus::kKeysFile : "";  // not those of another run
  }
  if (command.argv[0].empty() || find_program(command.argv[0]).empty()) {
    const std::string program = process.argv.empty() ? "ensonify-" + process.component : process.argv[0];
    throw ConfigError({{process.place, "processes." + process.name + ".run",
                        "there is no program " + program +
                            (process.argv.empty() ? " beside ensonify-run (is the component misspelt?)" : "")}});
  }
  for (const auto& [name, value] : process.env) {
    command.env[name] = value;
  }
  check_cpus(process);
  command.log_file = log_file(places, process.name);
  command.cpus = process.cpus;
  return command;
}

Command after_command(const AfterStep& step, const RunPlaces& places) {
  Command command;
  command.argv = step.words;
  const std::string& program = step.words[0];
  const bool ours = program == "ensonify" || program.starts_with("ensonify-");
  command.argv[0] = find_program(ours ? places.program_folder + "/" + program : program);
  if (command.argv[0].empty()) {
    throw ConfigError({{step.place, "after", "there is no program " + program}});
  }
  command.env = {{"ENSONIFY_OUT", places.out}, {"PYTHONPATH", python_path()}};
  return command;
}

void check_after(const Launch& launch, const RunPlaces& places) {
  std::vector<ConfigProblem> problems;
  for (const auto& step : launch.after) {
    if (step.words[0].starts_with(places.out + "/")) {
      continue;
    }
    try {
      after_command(step, places);
    } catch (const ConfigError& error) {
      problems.insert(problems.end(), error.problems().begin(), error.problems().end());
    }
  }
  if (!problems.empty()) {
    throw ConfigError(std::move(problems));
  }
}

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
      for (const auto& word : launch.after[i].words) {
        words += (words.empty() ? "" : " ") + word;
      }
      fmt::print(stderr, "ensonify run: after: `{}` ended with exit code {}\n", words, code);
      return code;
    }
  }
  return kExitOk;
}

}  // namespace ensonify::launcher
