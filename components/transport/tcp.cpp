#include "components/transport/tcp.h"

#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>

#include <cerrno>
#include <cstring>

#include "components/errors/exit_error.h"

namespace ensonify::tcp {
namespace {

Descriptor socket() { return Descriptor(::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)); }

}  // namespace

Descriptor listener(const std::string& address, int port) {
  Descriptor made = socket();
  const sockaddr_in own = ipv4(address, port);
  const int yes = 1;
  ::setsockopt(made.get(), SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  if (!made.is_open() || ::bind(made.get(), reinterpret_cast<const sockaddr*>(&own), sizeof own) != 0 ||
      ::listen(made.get(), 4) != 0) {
    throw UserError("cannot listen to TCP port " + std::to_string(port) + " of " + address + ": " +
                    std::strerror(errno) + "; allowed: a port that is free");
  }
  return made;
}

Accepted accept(const Descriptor& listener, const Senders& allowed) {
  sockaddr_in other{};
  socklen_t length = sizeof other;
  Descriptor connection(
      ::accept4(listener.get(), reinterpret_cast<sockaddr*>(&other), &length, SOCK_NONBLOCK | SOCK_CLOEXEC));
  const bool may = connection.is_open() && allowed.allow(other.sin_addr.s_addr);
  return {std::move(connection), may};
}

Descriptor connect(const std::string& address, int port, std::chrono::milliseconds limit) {
  Descriptor trying = socket();
  const sockaddr_in other = ipv4(address, port);
  if (::connect(trying.get(), reinterpret_cast<const sockaddr*>(&other), sizeof other) == 0) return trying;
  if (errno != EINPROGRESS || !comes_within(trying, POLLOUT, limit)) return Descriptor();
  int error = 0;
  socklen_t length = sizeof error;
  if (::getsockopt(trying.get(), SOL_SOCKET, SO_ERROR, &error, &length) != 0 || error != 0) return Descriptor();
  return trying;
}

}  // namespace ensonify::tcp
