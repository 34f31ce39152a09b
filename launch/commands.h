#pragma once

#include <set>
#include <string>

#include "launch/child.h"
#include "launch/file/launch_file.h"

namespace ensonify::launcher {

/// Folders that every process of a run gets.
struct RunPlaces {
  std::string program_folder;  // where the ensonify-* programs are
  std::string run_dir;
  std::string out;
};

/// The clock, with these processes in its program.
Command clock_command(const Launch& launch, const RunPlaces& places, const std::set<std::string>& hosted = {});

/// A native process: `ensonify-<component> --launch FILE ... --run-dir DIR --name NAME --clock ENDPOINT`. A foreign
/// program: its own words, and ENSONIFY_CLOCK, _NAME, _RUN_DIR, _OUT and _CONFIG (its parameters as JSON) in its
/// environment. Words that name a file of the project (`examples/agent.py`) become its path. Throws UserError when
/// there is no such program.
Command process_command(const Launch& launch, const ProcessSpec& process, const RunPlaces& places,
                        const std::string& clock_endpoint);

/// A step of `after:`; `ensonify` is our own dispatcher. Throws ConfigError when there is no such program.
Command after_command(const AfterStep& step, const RunPlaces& places);

/// Throws ConfigError with the steps of `after:` whose program is missing, so that nobody learns of it after hours of
/// running. One in the output folder may be made by the run.
void check_after(const Launch& launch, const RunPlaces& places);

/// Runs one command to its end with our standard output; Ctrl-C is handed on, a second one kills. Returns its exit code
/// if that is one of ours, else 3; 130 when interrupted.
int run_to_end(const Command& command);

/// Runs the steps of `after:` one after another. Stops at the first that fails and returns its exit code. What they
/// print goes to our standard output, or all of it to standard error. Throws ConfigError when there is no such program.
int run_after(const Launch& launch, const RunPlaces& places, bool output_to_error);

}  // namespace ensonify::launcher
