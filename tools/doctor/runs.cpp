#include "tools/doctor/runs.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "components/runtime/run_finder.h"

namespace ensonify::doctor {
namespace {

namespace fs = std::filesystem;

bool can_be_made(const fs::path& folder) { return ::access(folder.parent_path().c_str(), W_OK | X_OK) == 0; }

RunsFolder facts_of(const std::string& path) {
  RunsFolder folder{.path = path, .can_be_made = can_be_made(path)};
  struct stat info {};
  if (::lstat(path.c_str(), &info) != 0) return folder;
  folder.exists = true;
  folder.ours = S_ISDIR(info.st_mode) && info.st_uid == ::geteuid();
  folder.is_private = (info.st_mode & 077) == 0;
  return folder;
}

Finding live(const std::string& folder) {
  std::string names;
  for (const LiveRun& run : live_runs(folder))
    names += (names.empty() ? "" : ", ") + run.id() + " (" + run.about.text() + ")";
  return {"live runs", Level::kOk, names.empty() ? "none" : names, ""};
}

Finding left_behind(const std::string& folder) {
  const std::vector<std::string> dead = dead_runs(folder);
  if (dead.empty()) return {"dead runs", Level::kOk, "none left behind", ""};
  return {"dead runs", Level::kWarn, fmt::format("left behind: {}", fmt::join(dead, ", ")),
          "the next `ensonify run` removes them"};
}

}  // namespace

Findings check_runs() {
  const std::string folder = runs_folder();
  const char* runtime = std::getenv("XDG_RUNTIME_DIR");
  const bool requested = runtime != nullptr && *runtime == '/';
  return {judge_socket_path(requested ? std::string(runtime) + "/ensonify" : folder),
          judge_runs_folder(facts_of(folder)), live(folder), left_behind(folder)};
}

}  // namespace ensonify::doctor
