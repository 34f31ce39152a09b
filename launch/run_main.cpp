// ensonify-run: starts, supervises and ends the processes of a launch file.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <set>

#include "components/config/data_paths.h"
#include "components/errors/exit_error.h"
#include "components/errors/printable.h"
#include "components/runtime/tool.h"
#include "launch/check_ports.h"
#include "launch/commands.h"
#include "launch/file/launch_file.h"
#include "launch/hosted.h"
#include "launch/process/profiled_node.h"
#include "launch/profile.h"
#include "launch/run_dir.h"
#include "launch/supervisor.h"
#include "scenarios/world/world.h"

namespace {

using namespace ensonify;
using namespace ensonify::launcher;

struct Options {
  LaunchOptions launch;
  double rate = 0.0;
  bool free = false;
  bool in_process = false;
  bool hosted = false;
  bool json = false;
  bool quiet = false;
  bool profile = false;
  std::string junit;
  std::string name;
};

void declare(CLI::App& app, Options& options) {
  add_options(app, options.launch, true);
  auto* rate = app.add_option("--rate", options.rate, "sim seconds per wall second (default: as the launch file says)")
                   ->check(CLI::Range(1e-3, 1e6));
  app.add_flag("--free", options.free, "run as fast as possible")->excludes(rate);
  auto* name = app.add_option("--name", options.name, "what tools call this run by (`ensonify topic list --run NAME`)")
                   ->check(fault_of_run_name);
  auto* in_process = app.add_flag("--in-process", options.in_process,
                                  "run everything in one process, one thread (debugging, sanitizers)")
                         ->excludes(name);
  auto* hosted = app.add_flag("--hosted", options.hosted,
                              "run our own processes in the clock's program where they can be: the same results, more "
                              "steps a second of an agent")
                     ->excludes(in_process);
  app.add_flag("--profile", options.profile,
               "measure where the time of each process goes, by stage: a table, run.json, and <out>/profile.json for "
               "https://ui.perfetto.dev")
      ->excludes(in_process)
      ->excludes(hosted);
  app.add_option("--junit", options.junit, "write expectations and process endings as JUnit XML to this file");
  app.add_flag("--json", options.json, "print the result as JSON on standard output");
  app.add_flag("--quiet,-q", options.quiet, "no progress, no summary");
  app.footer(
      "Exit codes: 0 all well, 1 an expectation failed, 2 files or arguments are wrong, 3 a process died, 4 stall,\n"
      "5 data lost, 6 runs differ, 130 after Ctrl-C. Logs: <out>/log. Result: <out>/run.json.");
}

/// The whole run in one child process, ensonify-local, which writes to our standard error.
RunReport run_in_process(const Launch& launch) {
  Command command;
  command.argv = {program_folder() + "/ensonify-local"};
  const auto arguments = to_arguments(launch.options);
  command.argv.insert(command.argv.end(), arguments.begin(), arguments.end());
  RunReport report;
  remove_reports(launch.options.out);
  const auto began = std::chrono::steady_clock::now();
  report.code = run_to_end(command);
  report.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  if (report.code == kExitAssertionFailed) {
    report.cause = Fault{report.code, "", "assertions failed, or a mission was given up"};
  } else if (report.code != kExitOk) {
    report.cause = Fault{report.code, "", "the run in one process failed"};
  }
  if (const auto reported = read_clock_report(launch.options.out)) report.sim_s = reported->sim_s;
  report.expectations = read_expectations(launch.options.out + "/expect.json");
  return report;
}

/// What the user has to read: the words of those who refused their files, or the last lines of the culprit's log.
void explain(const RunReport& report, const std::string& out) {
  if (!report.cause || report.code == kExitInterrupted) {
    return;
  }
  const Fault& cause = *report.cause;
  if (cause.code == kExitUserError) {
    std::set<std::string> shown;
    for (const auto& process : report.processes) {
      const std::string text = tail(out + "/log/" + process.name + ".log", 50);
      if (process.fault && process.fault->code == kExitUserError && !text.empty() && shown.insert(text).second) {
        fmt::print(stderr, "{}\n", printable(text));
      }
    }
  } else if (cause.code == kExitAssertionFailed) {
    for (const auto& item : report.expectations) {
      if (!item.ok) {
        fmt::print(stderr, "failed: {}: {} (t={:.3f} s)\n", item.name, item.message, item.t_s);
      }
    }
  } else if (!cause.culprit.empty()) {
    const std::string log = out + "/log/" + cause.culprit + ".log";
    if (const std::string text = tail(log, 10); !text.empty() && !cause.message.ends_with(text)) {
      fmt::print(stderr, "{}, last lines:\n{}\n", log, printable(text));
    }
  }
  const bool named = cause.culprit.empty() || cause.message.starts_with(cause.culprit);
  fmt::print(stderr, "ensonify run: {}{}; t={:.3f} s; exit code {}\n", named ? "" : cause.culprit + " ",
             printable(cause.message), report.sim_s, report.code);
}

void summarize(const RunReport& report, const std::string& out) {
  if (report.sim_s > 0.0 && report.wall_s > 0.0) {
    fmt::print(stderr, "ensonify run: {:.1f} s of sim time in {:.1f} s ({:.1f}x real time); results in {}\n",
               report.sim_s, report.wall_s, report.sim_s / report.wall_s, out);
  }
  for (const auto& item : report.expectations) {
    fmt::print(stderr, "{}: {}\n", item.ok ? "ok" : "failed", item.name);
  }
}

int run(Options& options) {
  if (options.free) {
    options.launch.sets.emplace_back("clock.rate=free");
  } else if (options.rate > 0.0) {
    options.launch.sets.push_back(fmt::format("clock.rate={}", options.rate));
  }
  World world;
  const Launch launch =
      read_launch(options.launch, [&](ConfigReader& from, const std::string& file) { world = read_world(from, file); });
  const std::string& out = options.launch.out;
  if (const auto problems = unpaged_mission_problems(launch, {program_folder(), "", out}); !problems.empty()) {
    throw UserError(problems.front());
  }
  check_after(launch, {program_folder(), "", out});
  isa_of(launch);
  const OutFolder held(out);
  RunReport report;
  if (options.in_process) {
    if (!launch.exits.empty()) {
      throw UserError(launch.file + ": expects exit codes of processes, which there are none of with --in-process");
    }
    const auto kill = std::ranges::find(launch.injections, Injection::Kind::kKill, &Injection::kind);
    if (kill != launch.injections.end())
      throw UserError(kill->place + ": kills " + kill->target + ", and with --in-process that is all of the run");
    report = run_in_process(launch);
  } else {
    if (options.profile) ::setenv(kProfileVariable, "1", 1);
    else ::unsetenv(kProfileVariable);
    Supervisor supervisor(launch, world, program_folder(), options.quiet || options.json, options.name,
                          options.hosted ? hosted_processes(launch) : std::set<std::string>{});
    report = supervisor.run();
  }
  report.isa = name_of(isa_of(launch));
  if (options.profile) report.profiles = gather_profiles(out);
  write_text(out + "/run.json", json_text(report));
  if (!options.junit.empty()) {
    write_text(options.junit, junit_xml(report));
  }
  explain(report, out);
  if (!options.quiet) fmt::print(stderr, "{}", report.profiles.table);
  if (report.code == kExitOk) {
    if (!options.quiet) {
      summarize(report, out);
    }
    report.code = run_after(launch, {program_folder(), "", out}, options.json);
  }
  if (options.json) {
    fmt::print("{}", json_text(report));
  }
  return report.code;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("ensonify run: starts the processes of a launch file, watches over them and says how it went.");
  app.name("ensonify run");
  Options options;
  declare(app, options);
  if (const auto code = parse_command_line(app, argc, argv)) return *code;
  try {
    return run(options);
  } catch (const ExitError& error) {
    fmt::print(stderr, "{}\n", printable(error.what()));
    return error.code;
  } catch (const std::exception& error) {
    fmt::print(stderr, "ensonify run: {}\n", error.what());
    return kExitDied;
  }
}
