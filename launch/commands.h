#pragma once

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

Command clock_command(const Launch& launch, const RunPlaces& places);

/// A native process: `ensonify-<component> --launch FILE ... --run-dir DIR --name NAME --clock ENDPOINT`. A foreign
/// program: its own words, and ENSONIFY_CLOCK, _NAME, _RUN_DIR, _OUT and _CONFIG (its parameters as JSON) in its
/// environment. Words that name a file of the project (`examples/agent.py`) become its path. Throws UserError when
/// there is no such program.
Command process_command(const Launch& launch, const ProcessSpec& process, const RunPlaces& places,
                        const std::string& clock_endpoint);

/// A step of `after:`; `ensonify` is our own dispatcher. Throws UserError when there is no such program.
Command after_command(const std::vector<std::string>& words, const RunPlaces& places);

}  // namespace ensonify::launcher
