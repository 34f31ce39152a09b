#include "launch/run_dir.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <set>
#include <thread>

#include "components/errors/exit_error.h"

namespace ensonify::launcher {

namespace {

namespace fs = std::filesystem;

std::string reason() { return std::strerror(errno); }

/// An own folder that nobody else can enter. False when it is none and cannot be made one.
bool make_private(const std::string& folder) {
  if (::mkdir(folder.c_str(), 0700) != 0 && errno != EEXIST) {
    return false;
  }
  struct stat info {};
  if (::lstat(folder.c_str(), &info) != 0 || !S_ISDIR(info.st_mode) || info.st_uid != ::geteuid()) {
    errno = EPERM;
    return false;
  }
  return (info.st_mode & 077) == 0 || ::chmod(folder.c_str(), 0700) == 0;
}

/// A descriptor with an exclusive flock, or -1 when somebody holds it (or the file cannot be opened).
int try_lock(const std::string& file, bool wait) {
  const int fd = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  if (fd >= 0 && ::flock(fd, LOCK_EX | (wait ? 0 : LOCK_NB)) != 0) {
    ::close(fd);
    return -1;
  }
  return fd;
}

int remove_dead(const std::string& folder) {
  int removed = 0;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (!entry.path().filename().string().starts_with("run-")) {
      continue;
    }
    const int lock = try_lock(entry.path() / "lock", false);
    if (lock >= 0) {
      fs::remove_all(entry.path(), error);
      removed += error ? 0 : 1;
      ::close(lock);
    }
  }
  return removed;
}

/// Names are of live runs: those of dead ones have gone.
void refuse_second(const std::string& name, const std::string& folder) {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const AboutRun other = read_about(entry.path());
    if (!name.empty() && other.name == name) {
      throw UserError("--name: " + name + " is the name of a live run (" + other.text() +
                      "); choose another, or end that one with `ensonify clock stop --run " + name + "`");
    }
  }
}

/// Held while folders are made or cleared, so that a folder without its lock yet is never taken for a dead one.
struct FolderLock {
  explicit FolderLock(const std::string& folder) : fd(try_lock(folder + "/lock", true)) {}
  ~FolderLock() {
    if (fd >= 0) {
      ::close(fd);
    }
  }
  int fd;
};

constexpr pid_t kAllIsWell = 0;
constexpr std::chrono::seconds kGrace{1};

bool alive(pid_t group) { return ::kill(-group, 0) == 0; }

void end_groups(const std::set<pid_t>& groups) {
  for (const pid_t group : groups) {
    ::kill(-group, SIGTERM);
    ::kill(-group, SIGCONT);
  }
  const auto until = std::chrono::steady_clock::now() + kGrace;
  for (const pid_t group : groups) {
    // Not our children, so there is nothing to wait on.
    while (alive(group) && std::chrono::steady_clock::now() < until) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    ::kill(-group, SIGKILL);
  }
}

/// Reads group ids (negative: forget it) until the pipe closes.
[[noreturn]] void stand_guard(int read_fd, const std::string& run_dir) {
  std::set<pid_t> groups;
  pid_t reported = 0;
  for (;;) {
    const ssize_t got = ::read(read_fd, &reported, sizeof reported);
    if (got < 0 && errno == EINTR) {
      continue;
    }
    if (got != static_cast<ssize_t>(sizeof reported)) {
      break;
    }
    if (reported == kAllIsWell) {
      ::_exit(0);
    }
    reported > 0 ? void(groups.insert(reported)) : void(groups.erase(-reported));
  }
  end_groups(groups);
  std::error_code error;
  std::filesystem::remove_all(run_dir, error);
  ::_exit(0);
}

}  // namespace

std::string runs_folder() {
  if (const char* runtime = std::getenv("XDG_RUNTIME_DIR"); runtime != nullptr && *runtime == '/') {
    const std::string folder = std::string(runtime) + "/ensonify";
    if (folder.size() <= kLongestRunsFolder && make_private(folder)) {
      return folder;
    }
  }
  const std::string folder = "/tmp/ensonify-" + std::to_string(::geteuid());
  if (!make_private(folder)) {
    throw UserError(folder + ": cannot be used for the sockets of a run: " + reason() +
                    "; it must be a folder of this user, or set XDG_RUNTIME_DIR to one");
  }
  return folder;
}

int remove_dead_runs(const std::string& folder) {
  const FolderLock guard(folder);
  return remove_dead(folder);
}

RunDir::RunDir(const AboutRun& about) {
  const std::string folder = runs_folder();
  const FolderLock guard(folder);
  remove_dead(folder);
  refuse_second(about.name, folder);
  std::string path = folder + "/run-XXXXXX";
  if (::mkdtemp(path.data()) == nullptr) {
    throw UserError(path + ": cannot be made: " + reason());
  }
  path_ = path;
  lock_fd_ = try_lock(file("lock"), false);
  if (lock_fd_ < 0) {
    throw UserError(file("lock") + ": cannot be locked: " + reason());
  }
  try {
    write_about(path_, about);
  } catch (...) {  // nobody else clears up what is not made yet
    std::error_code error;
    fs::remove_all(path_, error);
    ::close(lock_fd_);
    throw;
  }
}

RunDir::~RunDir() {
  std::error_code error;
  fs::remove_all(path_, error);
  ::close(lock_fd_);
}

OutFolder::OutFolder(const std::string& path, std::chrono::milliseconds patience) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error) {
    throw UserError(path + ": cannot be made: " + error.message() + "; choose another folder with --out");
  }
  fd_ = ::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  constexpr std::chrono::milliseconds kStep{20};
  for (; fd_ >= 0 && ::flock(fd_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK; patience -= kStep) {
    if (patience <= kStep) {
      ::close(fd_);
      throw UserError(path + ": another run puts its results there; choose another folder with --out");
    }
    std::this_thread::sleep_for(kStep);
  }
}

OutFolder::~OutFolder() {
  if (fd_ >= 0) {
    ::close(fd_);
  }
}

Guard::Guard(const std::string& run_dir) {
  int pipe_fds[2];
  if (::pipe2(pipe_fds, O_CLOEXEC) != 0) {
    throw UserError(std::string("the launcher's guard cannot be started: ") + std::strerror(errno));
  }
  pid_ = ::fork();
  if (pid_ < 0) {
    throw UserError(std::string("the launcher's guard cannot be started: ") + std::strerror(errno));
  }
  if (pid_ == 0) {
    ::setsid();  // Ctrl-C and the death of the launcher's session are not meant for it
    ::signal(SIGPIPE, SIG_IGN);
    ::close(pipe_fds[1]);
    for (int fd = 0; fd < 3; ++fd) {  // whoever reads our output shall not wait for the guard
      ::close(fd);
    }
    ::open("/dev/null", O_RDWR);
    ::dup2(0, 1);
    ::dup2(0, 2);
    stand_guard(pipe_fds[0], run_dir);
  }
  ::close(pipe_fds[0]);
  write_fd_ = pipe_fds[1];
}

Guard::~Guard() {
  notify(kAllIsWell);
  ::close(write_fd_);
  ::waitpid(pid_, nullptr, 0);
}

void Guard::notify(pid_t value) const {
  [[maybe_unused]] const ssize_t written = ::write(write_fd_, &value, sizeof value);
}
void Guard::watch(pid_t group) { notify(group); }
void Guard::forget(pid_t group) { notify(-group); }

}  // namespace ensonify::launcher
