#pragma once

#include <optional>
#include <string>
#include <vector>

#include "launch/verdict.h"

namespace ensonify::launcher {

/// Outcome of one process.
struct ProcessReport {
  std::string name;
  std::string state;  // STARTING, CONNECTED, READY, RUNNING, DONE, FAILED, STOPPED (by the launcher)
  std::optional<Ending> ending;
  bool external = false;
  long max_rss_kib = 0;
  double cpu_s = 0.0;
  std::optional<Fault> fault;
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
  double sim_s = 0.0;
  double wall_s = 0.0;
  std::vector<ProcessReport> processes;
  std::vector<Expectation> expectations;
};

/// Contents of `<out>/clock.json`, written by its clock or, with --in-process, by the process that had none.
struct ClockReport {
  double sim_s = 0.0;  // reached
  int exit_code = 0;
  std::string culprit, message;
};

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

}  // namespace ensonify::launcher
