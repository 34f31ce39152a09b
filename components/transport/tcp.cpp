#include "components/transport/tcp.h"

#include <poll.h>
#include <sys/socket.h>

#include <cerrno>
#include <cstring>

#include "components/errors/exit_error.h"
#include "components/transport/socket_address.h"

namespace ensonify::tcp {
Descriptor listener(const std::string& address, int port) {
  const Address here = host_address(address, port);
  Descriptor made = socket_of(here.family, SOCK_STREAM);
  const SocketAddress own(here);
  const int yes = 1;
  ::setsockopt(made.get(), SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  if (!made.is_open() || ::bind(made.get(), own.data(), own.size()) != 0 || ::listen(made.get(), 4) != 0) {
    throw UserError("cannot listen to TCP port " + std::to_string(port) + " of " + address + ": " +
                    std::strerror(errno) + "; allowed: a port that is free");
  }
  return made;
}

Accepted accept(const Descriptor& listener, const Senders& allowed) {
  SocketAddress other;
  Descriptor connection(::accept4(listener.get(), other.data(), other.size_given(), SOCK_NONBLOCK | SOCK_CLOEXEC));
  const bool may = connection.is_open() && allowed.allow(other.address());
  return {std::move(connection), may};
}

Descriptor connect(const Address& address, std::chrono::milliseconds limit) {
  Descriptor trying = socket_of(address.family, SOCK_STREAM);
  const SocketAddress other(address);
  if (::connect(trying.get(), other.data(), other.size()) == 0) return trying;
  if (errno != EINPROGRESS || !comes_within(trying, POLLOUT, limit)) return Descriptor();
  int error = 0;
  socklen_t length = sizeof error;
  if (::getsockopt(trying.get(), SOL_SOCKET, SO_ERROR, &error, &length) != 0 || error != 0) return Descriptor();
  return trying;
}

}  // namespace ensonify::tcp
