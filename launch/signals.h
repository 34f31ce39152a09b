#pragma once

#include <chrono>
#include <string>

namespace ensonify::launcher {

/// SIGCHLD, SIGINT and SIGTERM as events to wait for. They stay blocked as long as this lives.
class Signals {
 public:
  Signals();
  ~Signals();
  Signals(const Signals&) = delete;
  Signals& operator=(const Signals&) = delete;

  /// Bytes that have arrived since the last call.
  struct Arrived {
    bool child = false;
    int interrupts = 0;
  };
  Arrived take();

  /// True when something arrived within `patience`.
  bool wait(std::chrono::milliseconds patience) const;
  int fd() const { return fd_; }

 private:
  int fd_ = -1;
};

/// Waits until `file` exists in a folder that is being watched, without polling.
class FileWatch {
 public:
  explicit FileWatch(const std::string& folder);
  ~FileWatch();
  FileWatch(const FileWatch&) = delete;
  FileWatch& operator=(const FileWatch&) = delete;

  /// Waits for a change in the folder or a signal, whichever comes first.
  void wait(const Signals& signals, std::chrono::milliseconds patience);

 private:
  int fd_ = -1;
};

}  // namespace ensonify::launcher
