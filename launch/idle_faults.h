#pragma once

#include <string>
#include <vector>

#include "launch/file/launch_file.h"
#include "launch/report.h"

namespace ensonify::launcher {

/// A failed verdict for each injection of a launch that did nothing in a run: its time never came, or its process knows
/// nothing of injections. By the logs in `out`, where a process writes a line when a fault first acts. What somebody
/// else started has no log there and is not judged.
std::vector<Expectation> idle_faults(const Launch& launch, const std::string& out, double sim_s);

}  // namespace ensonify::launcher
