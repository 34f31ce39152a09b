#include "components/transport/descriptor.h"

#include <poll.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <utility>

namespace ensonify {

int Descriptor::release() { return std::exchange(fd_, -1); }

void Descriptor::reset(int fd) {
  if (fd_ >= 0) ::close(fd_);
  fd_ = fd;
}

bool comes_within(const Descriptor& fd, short events, std::chrono::milliseconds limit) {
  pollfd wanted{fd.get(), events, 0};
  return ::poll(&wanted, 1, static_cast<int>(limit.count())) > 0;
}

std::optional<std::string> read_some(const Descriptor& fd) {
  std::array<char, 65536> buffer;
  const ssize_t got = ::read(fd.get(), buffer.data(), buffer.size());
  if (got > 0) return std::string(buffer.data(), static_cast<std::size_t>(got));
  if (got < 0 && (errno == EAGAIN || errno == EINTR)) return "";
  return std::nullopt;
}

}  // namespace ensonify
