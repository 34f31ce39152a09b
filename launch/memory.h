#pragma once

#include <sys/types.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "launch/child.h"

namespace ensonify::launcher {

/// Share of the machine's memory that a run may hold.
inline constexpr double kMostOfMachine = 0.8;

/// Memory of a process with all of its group, in MB.
struct Resident {
  double all_mb = 0.0;
  double own_mb = 0.0;  // without pages of files, which processes share
};

/// By process group, from /proc; none for groups that are gone.
std::map<pid_t, Resident> resident_of(const std::vector<pid_t>& groups);

/// Memory of this machine, or what its control group leaves us of it, in MB.
double machine_mb();

/// One process of a run and the `memory_mb` of its launch file.
struct Held {
  std::string name;
  Resident resident;
  std::optional<double> most_mb;
};

/// The process that holds more than it may or, when the run as a whole holds more than kMostOfMachine, the one that
/// holds the most.
std::optional<Fault> too_much_memory(const std::vector<Held>& processes, double machine_mb);

}  // namespace ensonify::launcher
