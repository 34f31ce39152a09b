#include "components/transport/outlet.h"

#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>

namespace ensonify {

std::ptrdiff_t Outlet::write_some(std::span<const std::byte> bytes) const {
  ssize_t taken = ::send(to_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
  if (taken < 0 && errno == ENOTSOCK) taken = ::write(to_.get(), bytes.data(), bytes.size());  // a line
  if (taken >= 0) return taken;
  return errno == EAGAIN || errno == EINTR || errno == ENOBUFS ? 0 : -1;
}

Outlet::Result Outlet::write(std::span<const std::byte> piece) {
  const auto gone = [&] {
    to_.reset();
    rest_.clear();
    return Result::gone;
  };
  if (!read_some(to_)) return gone();
  if (!rest_.empty()) {
    const std::ptrdiff_t taken = write_some(rest_);
    if (taken < 0) return gone();
    rest_.erase(rest_.begin(), rest_.begin() + taken);
    if (!rest_.empty()) return Result::busy;
  }
  const std::ptrdiff_t taken = write_some(piece);
  if (taken < 0) return gone();
  if (taken == 0 && !piece.empty()) return Result::busy;
  rest_.assign(piece.begin() + taken, piece.end());
  return Result::taken;
}

}  // namespace ensonify
