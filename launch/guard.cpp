#include "launch/guard.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <set>
#include <thread>

#include "components/errors/exit_error.h"

namespace ensonify::launcher {
namespace {

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
