#include "components/runtime/termination.h"

#include <poll.h>
#include <sys/eventfd.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <string>

#include "components/errors/exit_error.h"

namespace ensonify {

namespace {

sigset_t terminate() {
  sigset_t set;
  ::sigemptyset(&set);
  ::sigaddset(&set, SIGTERM);
  return set;
}

}  // namespace

Termination::Termination(std::function<void()> ask) {
  const sigset_t set = terminate();
  ::pthread_sigmask(SIG_BLOCK, &set, nullptr);
  signal_fd_ = ::signalfd(-1, &set, SFD_CLOEXEC);
  end_fd_ = ::eventfd(0, EFD_CLOEXEC);
  if (signal_fd_ < 0 || end_fd_ < 0) {
    throw ExitError(kExitDied, std::string("SIGTERM cannot be watched: ") + std::strerror(errno));
  }
  thread_ = std::thread([this, ask = std::move(ask)] {
    pollfd items[] = {{signal_fd_, POLLIN, 0}, {end_fd_, POLLIN, 0}};
    while (::poll(items, 2, -1) < 0) {
    }
    if (items[0].revents == 0) return;
    asked_ = true;
    ask();
  });
}

Termination::~Termination() {
  const std::uint64_t one = 1;
  [[maybe_unused]] const ssize_t written = ::write(end_fd_, &one, sizeof one);
  thread_.join();
  ::close(signal_fd_);
  ::close(end_fd_);
}

}  // namespace ensonify
