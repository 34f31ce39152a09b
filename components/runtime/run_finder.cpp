#include "components/runtime/run_finder.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <sys/file.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

#include "components/errors/exit_error.h"

namespace ensonify {

namespace {

namespace fs = std::filesystem;

constexpr const char* kEndpointFile = "clock.endpoint";
constexpr const char* kAboutFile = "about.json";
constexpr std::size_t kLongestName = 40;
constexpr std::string_view kIpc = "ipc://";
constexpr std::string_view kTcp = "tcp://";

/// A descriptor that closes itself.
struct Descriptor {
  explicit Descriptor(int number) : fd(number) {}
  ~Descriptor() {
    if (fd >= 0) ::close(fd);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int fd;
};

bool connects(int family, const sockaddr* address, socklen_t size) {
  const Descriptor probe(::socket(family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  if (probe.fd < 0) return false;
  if (::connect(probe.fd, address, size) == 0 || errno == EAGAIN) return true;  // EAGAIN: many are waiting to connect
  if (errno != EINPROGRESS) return false;
  fd_set writable;
  FD_ZERO(&writable);
  FD_SET(probe.fd, &writable);
  timeval patience{1, 0};  // the loopback interface answers at once
  int error = 1;
  socklen_t length = sizeof error;
  return ::select(probe.fd + 1, nullptr, &writable, nullptr, &patience) == 1 &&
         ::getsockopt(probe.fd, SOL_SOCKET, SO_ERROR, &error, &length) == 0 && error == 0;
}

/// A connection that says nothing does the clock no harm.
bool is_listening(std::string_view endpoint) {
  if (endpoint.starts_with(kIpc)) {
    const std::string_view path = endpoint.substr(kIpc.size());
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    if (path.empty() || path.size() >= sizeof address.sun_path) return false;
    std::memcpy(address.sun_path, path.data(), path.size());
    return connects(AF_UNIX, reinterpret_cast<const sockaddr*>(&address), sizeof address);
  }
  const std::size_t colon = endpoint.rfind(':');
  if (!endpoint.starts_with(kTcp) || colon < kTcp.size()) return false;
  const std::string host(endpoint.substr(kTcp.size(), colon - kTcp.size()));
  std::uint16_t port = 0;
  std::from_chars(endpoint.data() + colon + 1, endpoint.data() + endpoint.size(), port);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  return ::inet_pton(AF_INET, host.c_str(), &address.sin_addr) == 1 &&
         connects(AF_INET, reinterpret_cast<const sockaddr*>(&address), sizeof address);
}

std::string endpoint_in(const fs::path& folder) {
  std::ifstream file(folder / kEndpointFile);
  std::string endpoint;
  std::getline(file, endpoint);
  return endpoint;
}

std::vector<fs::path> run_directories(const std::string& folder) {
  std::vector<fs::path> found;
  std::error_code ignored;  // a folder that is gone holds no runs
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    if (entry.is_directory(ignored)) found.push_back(entry.path());
  }
  std::sort(found.begin(), found.end());
  return found;
}

/// Nobody holds the lock of this run directory. The folder's own lock is held meanwhile, as launchers do, so that a
/// launcher that is about to take its lock never finds it taken by us.
bool lock_is_free(const fs::path& run) {
  const Descriptor all(::open((run.parent_path() / "lock").c_str(), O_RDWR | O_CLOEXEC));
  if (all.fd >= 0) ::flock(all.fd, LOCK_EX);
  const Descriptor own(::open((run / "lock").c_str(), O_RDWR | O_CLOEXEC));
  return own.fd < 0 || ::flock(own.fd, LOCK_SH | LOCK_NB) == 0;
}

std::string names_of(const std::vector<LiveRun>& runs) {
  std::string names;
  for (const LiveRun& run : runs) names += (names.empty() ? "" : ", ") + run.id();
  return names;
}

/// A line for each run: name, launch file, age.
std::string lines_of(const std::vector<LiveRun>& runs) {
  std::string lines;
  for (const LiveRun& run : runs) lines += "\n  " + run.id() + ": " + run.about.text();
  return lines;
}

std::string hint(const std::string& folder) {
  const auto runs = live_runs(folder);
  return runs.empty() ? "no run is live; `ensonify run LAUNCH` starts one" : "live runs: " + names_of(runs);
}

LiveRun only_live_run(const std::string& folder) {
  const auto runs = live_runs(folder);
  if (runs.size() == 1) return runs.front();
  if (runs.size() > 1) throw UserError("several runs are live; name one with --run NAME:" + lines_of(runs));
  throw UserError("no run is live under " + folder +
                  "; `ensonify run LAUNCH` starts one, --run DIR names one that is elsewhere");
}

std::string folder_of(const std::string& run, const std::string& folder) {
  if (run.find('/') != std::string::npos) return run;
  for (const fs::path& directory : run_directories(folder)) {
    if (directory.filename() == run || read_about(directory).name == run) return directory.string();
  }
  throw UserError(run + ": there is no run of this name; " + hint(folder));
}

/// As a user would type it, where it is below the current folder.
std::string short_path(const std::string& path) {
  std::error_code error;
  const std::string here = fs::current_path(error).string() + "/";
  return path.starts_with(here) ? path.substr(here.size()) : path;
}

std::string age_text(std::int64_t seconds) {
  if (seconds < 120) return std::to_string(std::max<std::int64_t>(seconds, 0)) + " s";
  if (seconds < 7200) return std::to_string(seconds / 60) + " min";
  return seconds < 172800 ? std::to_string(seconds / 3600) + " h" : std::to_string(seconds / 86400) + " d";
}

bool can_be_used(const std::string& folder) {
  struct stat info {};
  if (folder.size() > kLongestRunsFolder) return false;
  if (::lstat(folder.c_str(), &info) == 0) return S_ISDIR(info.st_mode) && info.st_uid == ::geteuid();
  return ::access(fs::path(folder).parent_path().c_str(), W_OK | X_OK) == 0;
}

}  // namespace

std::string AboutRun::text() const {
  if (launch.empty()) return "of unknown launch";
  const auto now =
      std::chrono::duration_cast<std::chrono::seconds>(std::chrono::system_clock::now().time_since_epoch());
  return short_path(launch) + ", " + age_text(now.count() - began_unix_s) + " old, process " + std::to_string(process);
}

void write_about(const std::string& folder, const AboutRun& about) {
  const std::string file = (fs::path(folder) / kAboutFile).string();
  std::ofstream stream(file);
  stream << nlohmann::ordered_json{{"name", about.name},
                                   {"launch", about.launch},
                                   {"out", about.out},
                                   {"began_unix_s", about.began_unix_s},
                                   {"process", about.process}}
                .dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace)
         << '\n';
  if (!stream.flush())
    throw UserError(file + ": cannot be written: " + std::strerror(errno) +
                    "; allowed: a folder with room, see XDG_RUNTIME_DIR");
}

AboutRun read_about(const std::string& folder) {
  std::ifstream file(fs::path(folder) / kAboutFile);
  const nlohmann::json read = nlohmann::json::parse(file, nullptr, false);
  try {
    return {read.at("name"), read.at("launch"), read.at("out"), read.at("began_unix_s"), read.at("process")};
  } catch (const nlohmann::json::exception&) {
    return {};
  }
}

std::string fault_of_run_name(const std::string& name) {
  const bool letters = std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '-' || c == '_' || c == '.';
  });
  if (name.empty() || name.size() > kLongestName || !letters || name.front() == '-' || name.front() == '.')
    return "is no name of a run; allowed: 1 to " + std::to_string(kLongestName) +
           " letters, digits, '-', '_' and '.', beginning with a letter, a digit or '_'";
  return name.starts_with("run-") ? "is no name of a run: \"run-\" begins the ids of run directories" : "";
}

std::string LiveRun::id() const { return about.name.empty() ? fs::path(folder).filename().string() : about.name; }

std::string runs_folder() {
  if (const char* runtime = std::getenv("XDG_RUNTIME_DIR"); runtime != nullptr && *runtime == '/') {
    const std::string folder = std::string(runtime) + "/ensonify";
    if (can_be_used(folder)) return folder;
  }
  return "/tmp/ensonify-" + std::to_string(::geteuid());
}

std::vector<LiveRun> live_runs(const std::string& folder) {
  std::vector<LiveRun> runs;
  for (const fs::path& run : run_directories(folder)) {
    const std::string endpoint = endpoint_in(run);
    if (is_listening(endpoint)) runs.push_back({run.string(), endpoint, read_about(run)});
  }
  return runs;
}

std::vector<std::string> dead_runs(const std::string& folder) {
  std::vector<std::string> dead;
  for (const fs::path& run : run_directories(folder)) {
    if (!is_listening(endpoint_in(run)) && lock_is_free(run)) dead.push_back(run.string());
  }
  return dead;
}

LiveRun find_run(const std::string& run, const std::string& folder) {
  const char* from_environment = std::getenv("ENSONIFY_RUN");
  const std::string wanted = !run.empty() || from_environment == nullptr ? run : from_environment;
  if (wanted.empty()) return only_live_run(folder);
  LiveRun found{"", wanted, {}};
  if (!wanted.starts_with(kIpc) && !wanted.starts_with(kTcp)) {
    found.folder = folder_of(wanted, folder);
    found.endpoint = endpoint_in(found.folder);
    found.about = read_about(found.folder);
    if (found.endpoint.empty())
      throw UserError(wanted + ": is no run: it has ended, or its folder was removed; " + hint(folder));
  }
  if (!is_listening(found.endpoint))
    throw UserError(wanted + ": is dead: no clock listens at " + found.endpoint + "; " + hint(folder));
  return found;
}

}  // namespace ensonify
