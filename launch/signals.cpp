#include "launch/signals.h"

#include <poll.h>
#include <sys/inotify.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>

#include "components/errors/exit_error.h"

namespace ensonify::launcher {
namespace {

sigset_t watched() {
  sigset_t set;
  ::sigemptyset(&set);
  for (const int signal : {SIGCHLD, SIGINT, SIGTERM}) {
    ::sigaddset(&set, signal);
  }
  return set;
}

[[noreturn]] void fail(const std::string& what) { throw ExitError(kExitDied, what + ": " + std::strerror(errno)); }

}  // namespace

Signals::Signals() {
  const sigset_t set = watched();
  ::signal(SIGPIPE, SIG_IGN);
  if (::sigprocmask(SIG_BLOCK, &set, nullptr) != 0 || (fd_ = ::signalfd(-1, &set, SFD_CLOEXEC | SFD_NONBLOCK)) < 0) {
    fail("signals cannot be watched");
  }
}

Signals::~Signals() {
  take();
  const sigset_t set = watched();
  ::close(fd_);
  ::sigprocmask(SIG_UNBLOCK, &set, nullptr);
}

Signals::Arrived Signals::take() {
  Arrived arrived;
  signalfd_siginfo info{};
  while (::read(fd_, &info, sizeof info) == static_cast<ssize_t>(sizeof info)) {
    if (info.ssi_signo == SIGCHLD) {
      arrived.child = true;
    } else {
      ++arrived.interrupts;
    }
  }
  return arrived;
}

bool Signals::wait(std::chrono::milliseconds patience) const {
  pollfd item{fd_, POLLIN, 0};
  return ::poll(&item, 1, static_cast<int>(patience.count())) > 0;
}

FileWatch::FileWatch(const std::string& folder) {
  fd_ = ::inotify_init1(IN_CLOEXEC | IN_NONBLOCK);
  if (fd_ < 0 || ::inotify_add_watch(fd_, folder.c_str(), IN_MOVED_TO | IN_CLOSE_WRITE) < 0) {
    fail(folder + ": cannot be watched");
  }
}

FileWatch::~FileWatch() { ::close(fd_); }

void FileWatch::wait(const Signals& signals, std::chrono::milliseconds patience) {
  pollfd items[] = {{fd_, POLLIN, 0}, {signals.fd(), POLLIN, 0}};
  ::poll(items, 2, static_cast<int>(patience.count()));
  char events[4096];
  while (::read(fd_, events, sizeof events) > 0) {
  }
}

}  // namespace ensonify::launcher
