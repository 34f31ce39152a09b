#pragma once

#include "launch/commands.h"
#include "launch/file/launch_file.h"

namespace ensonify::launcher {

/// Runs one command to its end with our standard output; Ctrl-C is handed on, a second one kills. Returns its exit code
/// if that is one of ours, else 3; 130 when interrupted.
int run_to_end(const Command& command);

/// Runs the steps of `after:` one after another. Stops at the first that fails and returns its exit code. What they
/// print goes to our standard output, or all of it to standard error. Throws UserError when there is no such program.
int run_after(const Launch& launch, const RunPlaces& places, bool output_to_error);

}  // namespace ensonify::launcher
