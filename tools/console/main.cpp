// ensonify console: shows a run or a record in a browser.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <optional>

#include "components/config/data_paths.h"
#include "components/errors/exit_error.h"
#include "components/record/record_path.h"
#include "components/runtime/run_finder.h"
#include "components/runtime/tool.h"
#include "tools/console/console.h"
#include "tools/console/own_run.h"
#include "tools/console/page_files.h"

namespace {

namespace fs = std::filesystem;
using namespace ensonify;
using namespace ensonify::console;
using std::chrono::milliseconds;

struct Options {
  std::string target;  // launch file, record or folder of a run
  std::string run;
  RunOptions own;
  bool loop = false;
  bool stay = false;
  bool blind = false;
  AlarmLimits alarms;
  int port = 0;
  std::string folder;
};

void declare_limits(CLI::App& app, AlarmLimits& limits) {
  const auto limit = [&](const char* name, auto& value, const char* about, double most) {
    app.add_option(name, value, about)->capture_default_str()->check(CLI::Range(0.0, most))->group("Limits of alarms");
  };
  limit("--alarm-no-bottom", limits.pings_without_bottom, "pings in a row without a bottom", 1e6);
  limit("--alarm-off-line", limits.off_line_m, "distance from the runline, m", 1e6);
  limit("--alarm-late", limits.late_s, "time that the run stands behind its pace, s", 1e6);
  limit("--alarm-waited", limits.waited_s, "time that the run waited for one process, s", 1e6);
  limit("--alarm-disk", limits.disk_gb, "space left where results are written, GB", 1e6);
}

void declare(CLI::App& app, Options& options) {
  app.add_option(
      "target", options.target,
      "launch file to run, or record (MCAP) or folder of a run to play; nothing: live runs and records to open");
  auto* run =
      app.add_option("--run", options.run, "join this live run: its name, folder or clock's endpoint; waits for it");
  run->excludes(app.get_option("target"));
  app.add_option("--arg", options.own.args, "NAME=VALUE: an argument of the launch file; may be repeated")
      ->allow_extra_args(false);
  app.add_option("--set", options.own.sets,
                 "PROCESS.KEY=VALUE or SECTION.KEY=VALUE: changes a parameter; may be repeated")
      ->allow_extra_args(false);
  app.add_option("--out", options.own.out, "folder of results of the run")->capture_default_str();
  auto* rate = app.add_option("--rate", options.own.rate,
                              "sim seconds per wall second (default: as the launch file says; of a record 1)")
                   ->check(CLI::Range(1e-3, 1e6));
  app.add_flag("--free", options.own.free, "as fast as possible")->excludes(rate);
  app.add_flag("--loop", options.loop, "play a record again and again; times and numbers go on");
  app.add_option("--port", options.port, "port on the loopback interface (default: any that is free)")
      ->check(CLI::Range(1, 65535));
  app.add_option("--folder", options.folder,
                 "folder below which records may be opened (default: that of the record, or the run's --out)");
  app.add_flag("--stay", options.stay, "serve on after the run that it started, also without a terminal");
  app.add_flag("--blind", options.blind,
               "withhold the truth, for exercises: only what instruments say crosses the socket; no logs, and nothing "
               "else can be opened");
  declare_limits(app, options.alarms);
  app.footer(
      "Prints two URLs: one to view, one to control as well. Serves until Ctrl-C (without a terminal until the run "
      "that it\n"
      "started ends) and gives that run's exit code.");
}

bool is_record(const std::string& target) { return target.ends_with(".mcap") || fs::is_directory(target); }

/// What opens the record in a run's folder; nothing where there is none, or several.
std::optional<std::string> record_id(const std::string& folder) {
  try {
    return "record:" + record::record_path(folder);
  } catch (const UserError&) {
    return std::nullopt;
  }
}

std::vector<std::string> launch_files() {
  std::vector<std::string> found;
  std::error_code error;
  for (const std::string& root : data_roots())
    for (const auto& entry : fs::directory_iterator(root + "/launch", error))
      if (entry.path().extension() == ".yaml") found.push_back("launch/" + entry.path().filename().string());
  std::sort(found.begin(), found.end());
  return found;
}

/// `ended` is set to the exit code of a run that ended before the console was interrupted.
int serve(const Options& options, std::optional<int>& ended) {
  ConsoleOptions console_options;
  console_options.folder = options.folder;
  console_options.blind = options.blind;
  console_options.alarms = options.alarms;
  if (!options.blind) console_options.launches = launch_files();
  const bool starts = !options.target.empty() && !is_record(options.target);
  const double pace = options.own.rate > 0.0 ? options.own.rate : 1.0;
  console_options.record = {options.own.free && !starts ? 0.0 : pace, options.loop};
  if (!options.folder.empty() && !fs::is_directory(options.folder))
    throw UserError(options.folder + ": is no folder (--folder)");
  if (!options.target.empty() && !starts) {
    const std::string file = record::record_path(options.target);
    record_source(file, console_options.record);  // says what is wrong with it before anybody looks
    console_options.first = "record:" + file;
    if (options.folder.empty()) console_options.folder = fs::absolute(file).parent_path().string();
  } else if (!options.run.empty()) {
    console_options.first = "run:" + options.run;
  } else if (options.folder.empty()) {
    console_options.folder = starts ? options.own.out : "";
  }
  if (starts && find_data(options.target, {fs::current_path().string()}).empty())
    throw UserError(options.target + ": no such launch file, record or folder");

  Doors doors;
  std::optional<Console> console;
  Server server({options.port, page_files()}, doors, [&](Line& line) { return console->enter(line); });
  fmt::print("to view:    {}\nto control: {}\n", doors.view_url(), doors.control_url());
  std::fflush(stdout);

  std::optional<OwnRun> own;
  if (starts) {
    RunOptions run = options.own;
    run.launch = options.target;
    own.emplace(run);
    console_options.first = "run:" + own->name();
  }
  console.emplace(console_options, doors);
  const bool stay = options.stay || ::isatty(STDIN_FILENO) != 0;
  server.run([&]() -> milliseconds {
    if (interrupted()) return milliseconds(-1);
    console->tick(std::chrono::steady_clock::now());
    if (const auto code = own ? own->exit_code() : std::nullopt; code && !ended) {
      console->set_exit_code(*code);
      ended = code;
      if (!stay) return milliseconds(-1);
      console->set_first(record_id(options.own.out).value_or(console->first()));
      fmt::print("the run has ended, exit code {}; Ctrl-C ends the console\nopen this URL: {}\n", *code,
                 doors.view_url());
      std::fflush(stdout);
    }
    return milliseconds(console->watched() ? 5 : 50);
  });
  for (const auto& [why, times] : console->refused())
    fmt::print(stderr, "ensonify console: refused {}: {}\n", why, times);
  if (!own) return kExitOk;
  own->interrupt();
  return own->wait();
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Shows a run or a record in a browser.", "ensonify console");
  Options options;
  declare(app, options);
  std::optional<int> ended;
  const int code = tool_main(app, argc, argv, [&] { return serve(options, ended); });
  return ended.value_or(code);
}
