#pragma once

#include <string>

namespace ensonify::launcher {

/// Profiles of a run's processes (launch/process/profiled_node.h), put together.
struct Profiles {
  std::string json = "null";  // {PROCESS: {wall_s, processor_s, stages}}, for run.json
  std::string table;          // for people
};

/// Reads what the processes wrote into <out>/profile, and writes <out>/profile.json: one trace file, which
/// https://ui.perfetto.dev opens. Throws ExitError (5) when that cannot be written.
Profiles gather_profiles(const std::string& out);

}  // namespace ensonify::launcher
