#pragma once

#include <chrono>
#include <optional>
#include <string>

namespace ensonify {

/// An open file descriptor, closed with its owner.
class Descriptor {
 public:
  explicit Descriptor(int fd = -1) : fd_(fd) {}
  ~Descriptor() { reset(); }
  Descriptor(Descriptor&& other) noexcept : fd_(other.release()) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    reset(other.release());
    return *this;
  }

  int get() const { return fd_; }
  bool is_open() const { return fd_ >= 0; }
  int release();
  void reset(int fd = -1);

 private:
  int fd_;
};

/// Whether one of these events (POLLIN, POLLOUT) comes within the time.
bool comes_within(const Descriptor& fd, short events, std::chrono::milliseconds limit);

/// What is there to be read, 65,536 bytes at most: "" when nothing is; nothing when the other end is gone.
std::optional<std::string> read_some(const Descriptor& fd);

}  // namespace ensonify
