#pragma once

#include <atomic>
#include <functional>
#include <thread>

namespace ensonify {

/// While it lives, SIGTERM is a call from a thread of its own instead of the end of the process between two
/// instructions: whoever writes files completes them. Made before other threads are, which inherit that it is blocked.
/// It stays blocked, as files are completed after this has gone.
class Termination {
 public:
  /// `ask` is called once, from the other thread.
  explicit Termination(std::function<void()> ask);
  ~Termination();
  Termination(const Termination&) = delete;
  Termination& operator=(const Termination&) = delete;

  bool asked() const { return asked_; }

 private:
  std::atomic<bool> asked_{false};
  int signal_fd_ = -1;
  int end_fd_ = -1;
  std::thread thread_;
};

}  // namespace ensonify
