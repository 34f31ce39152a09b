#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

/// Limits of what is good enough. Pure: the facts come from machine.h.
namespace ensonify::doctor {

enum class Level { kOk, kWarn, kFail };

/// Finding of one check. `advice` is empty when all is well.
struct Finding {
  std::string check;  // one or two words
  Level level = Level::kOk;
  std::string text;
  std::string advice;
};
using Findings = std::vector<Finding>;

inline const char* word_of(Level level) { return level == Level::kOk ? "ok" : level == Level::kWarn ? "warn" : "fail"; }

/// `flags`: the "flags" line of /proc/cpuinfo; "" when it cannot be read.
Finding judge_cpu(const std::string& flags);
Finding judge_cores(int available);
/// Memory that may still be used, in bytes, a container's limit included.
Finding judge_memory(std::uint64_t available_bytes);

/// Facts of a folder by statvfs and access.
struct Disk {
  std::string folder;
  std::optional<std::uint64_t> free_bytes;  // nothing: it cannot be read
  bool writable = false;
};
/// `needed`: below it fails, below ten times it warns.
Finding judge_disk(const std::string& check, const Disk& disk, std::uint64_t needed_bytes);

Finding judge_open_files(std::uint64_t soft_limit);
/// `source`: the kernel's clock source; "" when unknown. `cost_ns`: of reading the clock once.
Finding judge_clock(const std::string& source, double cost_ns);

/// A folder that holds run directories, or would.
struct RunsFolder {
  std::string path;
  bool exists = false;
  bool ours = false;         // owned by this user
  bool is_private = false;   // mode 0700
  bool can_be_made = false;  // its parent can be written
};
/// A folder that is too long for the paths of sockets cannot be used.
Finding judge_socket_path(const std::string& folder);
Finding judge_runs_folder(const RunsFolder& folder);

/// "1.5 GB"
std::string size_text(std::uint64_t bytes);

}  // namespace ensonify::doctor
