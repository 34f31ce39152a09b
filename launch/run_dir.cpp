#include "launch/run_dir.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "components/errors/exit_error.h"
#include "components/runtime/run_finder.h"

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

RunDir::RunDir() {
  const std::string folder = runs_folder();
  const FolderLock guard(folder);
  remove_dead(folder);
  std::string path = folder + "/run-XXXXXX";
  if (::mkdtemp(path.data()) == nullptr) {
    throw UserError(path + ": cannot be made: " + reason());
  }
  path_ = path;
  lock_fd_ = try_lock(file("lock"), false);
  if (lock_fd_ < 0) {
    throw UserError(file("lock") + ": cannot be locked: " + reason());
  }
}

RunDir::~RunDir() {
  std::error_code error;
  fs::remove_all(path_, error);
  ::close(lock_fd_);
}

}  // namespace ensonify::launcher
