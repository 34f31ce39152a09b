#pragma once

#include "components/runtime/config/launch_file.h"
#include "launch/commands.h"

namespace ensonify::launcher {

/// Runs the steps of `after:` one after another, with our standard output. Stops at the first that fails and returns
/// its exit code if that is one of ours, else 3; 130 when interrupted. Throws UserError when there is no such program.
int run_after(const Launch& launch, const RunPlaces& places);

}  // namespace ensonify::launcher
