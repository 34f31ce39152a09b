#include "tools/doctor/machine.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <sched.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>

#include "components/config/data_paths.h"
#include "components/runtime/run_finder.h"
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

namespace {

namespace fs = std::filesystem;

std::string shell_quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

/// What a shell command prints; `ok` says whether it succeeded.
std::string output_of(const std::string& command, bool& ok) {
  std::string text;
  std::FILE* pipe = ::popen(command.c_str(), "r");
  ok = false;
  if (pipe == nullptr) return text;
  char part[4096];
  for (std::size_t got = 0; (got = std::fread(part, 1, sizeof part, pipe)) > 0;) text.append(part, got);
  const int status = ::pclose(pipe);
  ok = WIFEXITED(status) && WEXITSTATUS(status) == 0;
  return text;
}

std::vector<fs::path> programs() {
  std::vector<fs::path> found;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(program_folder(), ignored)) {
    const bool ours = entry.path().filename().string().starts_with("ensonify");
    if (ours && entry.is_regular_file(ignored) && ::access(entry.path().c_str(), X_OK) == 0)
      found.push_back(entry.path());
  }
  std::sort(found.begin(), found.end());
  return found;
}

std::string dotted(int major, int minor, int patch) { return fmt::format("{}.{}.{}", major, minor, patch); }

template <class Function>
Function symbol(void* library, const char* name) {
  return reinterpret_cast<Function>(::dlsym(library, name));
}

std::string zmq_version(void* library) {
  const auto version = symbol<void (*)(int*, int*, int*)>(library, "zmq_version");
  if (version == nullptr) return "";
  int major = 0, minor = 0, patch = 0;
  version(&major, &minor, &patch);
  return dotted(major, minor, patch);
}

std::string gdal_version(void* library) {
  const auto version = symbol<const char* (*)(const char*)>(library, "GDALVersionInfo");
  return version == nullptr ? "" : version("RELEASE_NAME");
}

std::string embree_version(void* library) {
  const auto make = symbol<void* (*)(const char*)>(library, "rtcNewDevice");
  const auto property = symbol<ssize_t (*)(void*, int)>(library, "rtcGetDeviceProperty");
  const auto release = symbol<void (*)(void*)>(library, "rtcReleaseDevice");
  if (make == nullptr || property == nullptr || release == nullptr) return "";
  void* device = make("threads=1");
  if (device == nullptr) return "";
  constexpr int kVersionProperty = 0;  // RTC_DEVICE_PROPERTY_VERSION, e.g. 31305
  const auto version = static_cast<int>(property(device, kVersionProperty));
  release(device);
  return dotted(version / 10000, version / 100 % 100, version % 100);
}

/// Versions of the large libraries among those that our programs load: asked of the library itself.
Findings versions_of(const Libraries& all) {
  struct Known {
    const char* check;
    const char* prefix;
    std::string (*version)(void*);
    const char* uses;
  };
  constexpr Known kKnown[] = {{"zmq", "libzmq.so", zmq_version, "every process"},
                              {"embree", "libembree", embree_version, "the heads"},
                              {"gdal", "libgdal.so", gdal_version, "the terrain pager and ensonify plot"}};
  Findings findings;
  for (const Known& known : kKnown) {
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const auto& l) { return l.first.starts_with(known.prefix); });
    if (found == all.end()) continue;  // no program beside us uses it
    void* library = ::dlopen(found->second.c_str(), RTLD_NOW | RTLD_LOCAL);
    const std::string version = library == nullptr ? "" : known.version(library);
    if (version.empty()) {
      findings.push_back({known.check, Level::kFail, found->first + " does not load",
                          std::string("it is used by ") + known.uses + "; `./dev build` installs what is missing"});
    } else {
      findings.push_back({known.check, Level::kOk, version + ", " + found->second, ""});
    }
  }
  return findings;
}

Findings check_programs() {
  std::map<std::string, std::vector<std::string>> missing;
  Libraries all;
  const std::vector<fs::path> found = programs();
  for (const fs::path& program : found) {
    bool ok = false;  // what `ldd` does
    const std::string trace = output_of("LD_TRACE_LOADED_OBJECTS=1 " + shell_quoted(program.string()) + " 2>&1", ok);
    for (const auto& [name, path] : read_trace(trace)) {
      if (path.empty()) missing[name].push_back(program.filename().string());
      else all[name] = path;
    }
  }
  Findings findings{judge_libraries(found.size(), missing)};
  for (Finding& version : versions_of(all)) findings.push_back(std::move(version));
  return findings;
}

Finding check_data() {
  const std::vector<std::string> roots = data_roots();
  if (!roots.empty()) return {"data", Level::kOk, "launch files and scenarios in " + roots.front(), ""};
  return {"data", Level::kFail, "the project's launch files and scenarios are nowhere to be found",
          "set ENSONIFY_SHARE to the folder that holds launch/ and scenarios/"};
}

Finding check_python() {
  const std::string client = find_data("clients/python", {});
  const std::string script =
      "import sys\n"
      "try:\n"
      "    import numpy, zmq, msgpack, ensonify\n"
      "except Exception as error:\n"
      "    sys.exit(print(f'{sys.executable} cannot import the client: {error}') or 1)\n"
      "print(f'{sys.executable} {sys.version.split()[0]}, client {ensonify.__version__}, numpy {numpy.__version__}, '\n"
      "      f'pyzmq {zmq.__version__}')\n";
  const std::string path = client.empty() ? "" : "PYTHONPATH=" + shell_quoted(client) + "${PYTHONPATH:+:$PYTHONPATH} ";
  bool ok = false;
  std::string stated = output_of(path + "PYTHONDONTWRITEBYTECODE=1 python3 -c " + shell_quoted(script) + " 2>&1", ok);
  while (stated.ends_with('\n')) stated.pop_back();
  if (ok) return {"python", Level::kOk, stated, ""};
  return {"python", Level::kWarn, stated,
          "`python3` of a launch file is this one; agents need python3-zmq, python3-msgpack and python3-numpy, or pip "
          "install clients/python"};
}

}  // namespace

Libraries read_trace(const std::string& trace) {
  Libraries libraries;
  std::istringstream lines(trace);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string name, arrow, path;
    if (!(words >> name >> arrow >> path) || arrow != "=>") continue;
    libraries[name] = path == "not" ? "" : path;
  }
  return libraries;
}

Finding judge_libraries(std::size_t programs, const std::map<std::string, std::vector<std::string>>& missing) {
  if (missing.empty()) return {"programs", Level::kOk, fmt::format("{}, none lacks a library", programs), ""};
  std::string text;
  for (const auto& [library, users] : missing) {
    text += fmt::format("{}{} is missing for {}", text.empty() ? "" : "; ", library, fmt::join(users, ", "));
  }
  return {"programs", Level::kFail, text,
          "`./dev build` installs what is missing, or apt install the package that holds it"};
}

Findings check_installation() {
  Findings findings = check_programs();
  findings.push_back(check_data());
  findings.push_back(check_python());
  return findings;
}

}  // namespace ensonify::doctor
