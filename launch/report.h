#pragma once

#include <chrono>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "launch/child.h"
#include "launch/file/launch_file.h"
#include "launch/profile.h"
#include "scenarios/world/world.h"

namespace ensonify::launcher {

/// When, in sim time, and why the run had to go on without a process that it may lose.
struct Loss {
  std::string process;
  double at_s = 0.0;
  std::string why;
};

/// Outcome of one process.
struct ProcessReport {
  std::string name;
  std::string state;  // STARTING, CONNECTED, READY, RUNNING, DONE, FAILED, LOST, STOPPED (by the launcher)
  std::optional<Ending> ending;
  bool external = false;
  bool hosted = false;  // in the clock's program, which its memory and processor time are counted for
  long max_rss_kib = 0;
  double cpu_s = 0.0;
  std::optional<Fault> fault;
  std::optional<Loss> loss;
};

/// One line of `<out>/expect.json`, which the expect process writes.
struct Expectation {
  std::string name;
  bool ok = false;
  double t_s = 0.0;  // sim time at which it was decided
  std::string message;
};

struct RunReport {
  int code = 0;
  std::optional<Fault> cause;
  std::string isa;  // vector instructions that rays were traced with
  double sim_s = 0.0;
  double wall_s = 0.0;
  std::vector<ProcessReport> processes;
  std::vector<Expectation> expectations;
  Profiles profiles;  // with --profile
};

/// Contents of `<out>/clock.json`, written by its clock or, with --in-process, by the process that had none.
struct ClockReport {
  double sim_s = 0.0;  // reached
  int exit_code = 0;
  std::string culprit, message;
  std::vector<Loss> losses;
  std::map<std::string, int> exit_codes;  // of processes that took leave with another than 0
};

/// Whom the clock has done without, of its report or of its answer to `status`.
std::vector<Loss> losses_in(const nlohmann::json& report);

/// Nothing when the file is not there or is not whole.
std::optional<ClockReport> read_clock_report(const std::string& out);

/// Removes what an earlier run reported in this folder.
void remove_reports(const std::string& out);

/// Empty when the file is not there. Throws ExitError (3) when it is not what expect writes.
std::vector<Expectation> read_expectations(const std::string& file);

/// JUnit XML: a suite of the expectations and one of the processes' endings.
std::string junit_xml(const RunReport& report);

/// For scripts: exit code, cause, times, and memory per process.
std::string json_text(const RunReport& report);

/// Makes a folder for results, with those above it. Throws UserError when that is not possible.
void make_folder(const std::string& folder);

/// Throws ExitError (5) when the file cannot be written whole.
void write_text(const std::string& file, const std::string& text);

/// Length of the run in sim time: its hard end, else what its runlines take at mission speed with their turns;
/// nothing when neither is known.
std::optional<double> expected_duration_s(const Launch& launch, const World& world);

/// "t 123.4 s  12.3x real time  about 1 min 20 s left  RUNNING". Times in s; the rate is of the whole run.
std::string progress_text(double sim_s, double wall_s, std::optional<double> duration_s, const std::string& state);

/// Shows one line of progress that overwrites itself on a terminal; into a file or pipe, a line every ten seconds.
class Progress {
 public:
  Progress(bool quiet, std::optional<double> duration_s);
  void show(double sim_s, double wall_s, const std::string& state);
  /// Ends the line, so that what follows begins a new one.
  void finish();

 private:
  bool quiet_;
  bool terminal_;
  std::optional<double> duration_s_;
  bool shown_ = false;
  double next_line_s_ = 10.0;
};

}  // namespace ensonify::launcher
