#include "tools/doctor/judgement.h"

#include <fmt/format.h>

#include <sstream>

#include "components/runtime/run_finder.h"

namespace ensonify::doctor {

namespace {

constexpr std::uint64_t kMega = 1'000'000;

bool has_word(const std::string& text, const std::string& word) {
  std::istringstream words(text);
  for (std::string next; words >> next;) {
    if (next == word) return true;
  }
  return false;
}

}  // namespace

std::string size_text(std::uint64_t bytes) {
  const auto b = static_cast<double>(bytes);
  return b >= 1e9 ? fmt::format("{:.1f} GB", b * 1e-9) : fmt::format("{:.0f} MB", b * 1e-6);
}

Finding judge_cpu(const std::string& flags) {
  if (flags.empty()) return {"cpu", Level::kWarn, "its features cannot be read", "/proc/cpuinfo must be readable"};
  for (const char* needed : {"avx2", "fma"}) {
    if (!has_word(flags, needed)) {
      return {"cpu", Level::kFail, std::string("has no ") + needed,
              "rays are traced with AVX2 so that results match: use a machine of 2014 or later, or let the virtual "
              "machine see its host's CPU"};
    }
  }
  return {"cpu", Level::kOk, "avx2 and fma", ""};
}

Finding judge_cores(int available) {
  if (available < 2) {
    return {"cores", Level::kWarn, "1 for us",
            "runs are correct on one core, but a paced run may be late; give it two or more"};
  }
  return {"cores", Level::kOk, fmt::format("{} for us", available), ""};
}

Finding judge_memory(std::uint64_t available_bytes) {
  const std::string text = size_text(available_bytes) + " available";
  const char* advice = "a survey takes about 2 GB, large tile sets more: close other programs or raise the limit";
  if (available_bytes < 500 * kMega) return {"memory", Level::kFail, text, advice};
  if (available_bytes < 2000 * kMega) return {"memory", Level::kWarn, text, advice};
  return {"memory", Level::kOk, text, ""};
}

Finding judge_disk(const std::string& check, const Disk& disk, std::uint64_t needed_bytes) {
  if (!disk.free_bytes) return {check, Level::kFail, disk.folder + " cannot be read", "name another folder"};
  const std::string text = fmt::format("{} free in {}", size_text(*disk.free_bytes), disk.folder);
  if (!disk.writable) return {check, Level::kFail, disk.folder + " cannot be written", "name another folder"};
  const std::string advice = "make room: a run whose record does not fit ends with exit code 5";
  if (*disk.free_bytes < needed_bytes) return {check, Level::kFail, text, advice};
  if (*disk.free_bytes < 10 * needed_bytes) return {check, Level::kWarn, text, advice};
  return {check, Level::kOk, text, ""};
}

Finding judge_open_files(std::uint64_t soft_limit) {
  const std::string text = fmt::format("{} per process (ulimit -n)", soft_limit);
  const char* advice = "each connection takes one: ulimit -n 4096";
  if (soft_limit < 128) return {"open files", Level::kFail, text, advice};
  if (soft_limit < 1024) return {"open files", Level::kWarn, text, advice};
  return {"open files", Level::kOk, text, ""};
}

Finding judge_clock(const std::string& source, double cost_ns) {
  const std::string text =
      fmt::format("{}, {:.0f} ns per reading", source.empty() ? "unknown source" : source, cost_ns);
  constexpr double kSlow_ns = 500.0;
  if (source == "hpet" || source == "acpi_pm" || source == "jiffies" || cost_ns > kSlow_ns) {
    return {"clock", Level::kWarn, text,
            "reading the time is slow or coarse here; paced runs keep worse time. See /sys/devices/system/clocksource"};
  }
  return {"clock", Level::kOk, text, ""};
}

Finding judge_socket_path(const std::string& folder) {
  const std::string text = fmt::format("{} has {} of at most {} bytes", folder, folder.size(), kLongestRunsFolder);
  if (folder.size() <= kLongestRunsFolder) return {"socket paths", Level::kOk, text, ""};
  return {"socket paths", Level::kWarn, text, "/tmp is used instead; or set XDG_RUNTIME_DIR to a shorter folder"};
}

Finding judge_runs_folder(const RunsFolder& folder) {
  if (!folder.exists && folder.can_be_made) return {"run folder", Level::kOk, folder.path + " will be made", ""};
  if (!folder.exists) {
    return {"run folder", Level::kFail, folder.path + " cannot be made",
            "runs need a private folder for their sockets: set XDG_RUNTIME_DIR to a folder of yours"};
  }
  if (!folder.ours) {
    return {"run folder", Level::kFail, folder.path + " belongs to somebody else",
            "have it removed, or set XDG_RUNTIME_DIR to a folder of yours"};
  }
  if (!folder.is_private) {
    return {"run folder", Level::kWarn, folder.path + " can be entered by others",
            "the next run closes it; or: chmod 700 " + folder.path};
  }
  return {"run folder", Level::kOk, folder.path + " is private", ""};
}

}  // namespace ensonify::doctor
