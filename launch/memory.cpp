#include "launch/memory.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>

namespace ensonify::launcher {

namespace fs = std::filesystem;

std::map<pid_t, Resident> resident_of(const std::vector<pid_t>& groups) {
  static const double page_mb = 1e-6 * static_cast<double>(::sysconf(_SC_PAGESIZE));
  std::map<pid_t, Resident> found;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator("/proc", ignored)) {
    const std::string name = entry.path().filename();
    pid_t pid = 0;
    if (std::from_chars(name.data(), name.data() + name.size(), pid).ptr != name.data() + name.size()) continue;
    const pid_t group = ::getpgid(pid);
    if (std::find(groups.begin(), groups.end(), group) == groups.end()) continue;
    double size = 0.0, resident = 0.0, shared = 0.0;
    if (std::ifstream(entry.path() / "statm") >> size >> resident >> shared) {
      found[group].all_mb += page_mb * resident;
      found[group].own_mb += page_mb * (resident - shared);
    }
  }
  return found;
}

double machine_mb() {
  double most_mb = 1e-6 * static_cast<double>(::sysconf(_SC_PAGESIZE)) * static_cast<double>(::sysconf(_SC_PHYS_PAGES));
  double group_bytes = 0.0;
  if (std::ifstream("/sys/fs/cgroup/memory.max") >> group_bytes) most_mb = std::min(most_mb, 1e-6 * group_bytes);
  return most_mb;
}

std::optional<Fault> too_much_memory(const std::vector<Held>& processes, double machine_mb) {
  double sum_mb = 0.0;
  for (const Held& process : processes) {
    const double holds_mb = process.resident.all_mb;
    if (process.most_mb && holds_mb > *process.most_mb) {
      return Fault{kExitDied, process.name,
                   fmt::format("holds {:.0f} MB of memory, its memory_mb is {:g}", holds_mb, *process.most_mb)};
    }
    sum_mb += process.resident.own_mb;
  }
  if (processes.empty() || sum_mb <= kMostOfMachine * machine_mb) return std::nullopt;
  const Held& most = *std::max_element(processes.begin(), processes.end(), [](const Held& a, const Held& b) {
    return a.resident.own_mb < b.resident.own_mb;
  });
  return Fault{
      kExitDied, most.name,
      fmt::format("holds {:.0f} MB of the run's {:.0f} MB of memory, which may be {:g} % of this machine's {:.0f} MB",
                  most.resident.own_mb, sum_mb, 100.0 * kMostOfMachine, machine_mb)};
}

}  // namespace ensonify::launcher
