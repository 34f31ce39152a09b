#include "tools/doctor/machine.h"

#include <fmt/format.h>
#include <sched.h>
#include <sys/resource.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "components/config/data_paths.h"
#include "tools/doctor/judgement.h"

namespace ensonify::doctor {
namespace {

constexpr std::uint64_t kMega = 1'000'000;

std::string first_line(const std::string& file) {
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);
  return line;
}

std::string cpu_flags() {
  std::ifstream cpuinfo("/proc/cpuinfo");
  for (std::string line; std::getline(cpuinfo, line);) {
    if (line.starts_with("flags")) return line;
  }
  return "";
}

int cores() {
  cpu_set_t available;
  CPU_ZERO(&available);
  return ::sched_getaffinity(0, sizeof available, &available) == 0 ? CPU_COUNT(&available) : 1;
}

/// What the kernel would give, but no more than a container (cgroup 2) leaves.
std::uint64_t available_memory() {
  std::uint64_t available = 0;
  std::ifstream meminfo("/proc/meminfo");
  for (std::string line; std::getline(meminfo, line);) {
    std::istringstream words(line);
    std::string key;
    std::uint64_t kib = 0;
    if (words >> key >> kib && key == "MemAvailable:") available = kib * 1024;
  }
  std::uint64_t limit = 0;
  std::uint64_t used = 0;
  std::istringstream limit_text(first_line("/sys/fs/cgroup/memory.max"));  // a number, or "max"
  std::istringstream used_text(first_line("/sys/fs/cgroup/memory.current"));
  if (limit_text >> limit && used_text >> used) available = std::min(available, limit > used ? limit - used : 0);
  return available;
}

Disk disk_of(const std::string& folder) {
  Disk disk{folder, {}, ::access(folder.c_str(), W_OK | X_OK) == 0};
  struct statvfs info {};
  if (::statvfs(folder.c_str(), &info) == 0) disk.free_bytes = std::uint64_t{info.f_bavail} * info.f_frsize;
  return disk;
}

std::uint64_t open_files() {
  rlimit limit{};
  return ::getrlimit(RLIMIT_NOFILE, &limit) == 0 ? limit.rlim_cur : 0;
}

/// What pagers keep there; the folder need not exist.
Finding tile_cache(const std::string& folder) {
  namespace fs = std::filesystem;
  if (folder.empty()) return {"tile cache", Level::kOk, "none: neither XDG_CACHE_HOME nor HOME is set", ""};
  std::uint64_t bytes = 0;
  std::error_code gone;
  for (fs::directory_iterator at(folder, gone), end; !gone && at != end; at.increment(gone)) {
    std::error_code error;
    const std::uint64_t size = at->file_size(error);
    if (!error) bytes += size;
  }
  return {"tile cache", Level::kOk, fmt::format("{} in {}", size_text(bytes), folder), ""};
}

/// Mean of many readings of the clock that paces runs.
double clock_cost_ns() {
  using Clock = std::chrono::steady_clock;
  constexpr int kReadings = 20000;
  const auto begin = Clock::now();
  auto last = begin;
  for (int i = 0; i < kReadings; ++i) last = Clock::now();
  return std::chrono::duration<double, std::nano>(last - begin).count() / kReadings;
}

}  // namespace

Findings check_machine(const std::string& out) {
  const std::string source = first_line("/sys/devices/system/clocksource/clocksource0/current_clocksource");
  Findings findings{judge_cpu(cpu_flags()),
                    judge_cores(cores()),
                    judge_memory(available_memory()),
                    judge_disk("results", disk_of(out), 600 * kMega),  // the demo's record is at most 500 MB
                    judge_disk("/tmp", disk_of("/tmp"), 20 * kMega),
                    judge_disk("/dev/shm", disk_of("/dev/shm"), 8 * kMega),
                    judge_open_files(open_files()),
                    judge_clock(source, clock_cost_ns()),
                    tile_cache(tile_cache_folder())};
  for (Finding& finding : findings) {  // only the Python libraries that agents use may want shared memory
    if (finding.check == "/dev/shm" && finding.level == Level::kFail) finding.level = Level::kWarn;
  }
  return findings;
}

}  // namespace ensonify::doctor
