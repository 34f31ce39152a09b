#include "components/transport/udp_sender.h"

#include <netinet/in.h>
#include <sys/socket.h>

#include <cerrno>
#include <cstring>

#include "components/errors/exit_error.h"
#include "components/transport/socket_address.h"

namespace ensonify {

namespace {

/// Whether the group's datagrams now leave by that interface.
bool send_group(int socket, const Address& group, const Address& interface, int ttl) {
  if (group.family == Address::Family::kIpv6) {
    const auto by = static_cast<int>(group.interface);
    return ::setsockopt(socket, IPPROTO_IPV6, IPV6_MULTICAST_IF, &by, sizeof by) == 0 &&
           ::setsockopt(socket, IPPROTO_IPV6, IPV6_MULTICAST_HOPS, &ttl, sizeof ttl) == 0;
  }
  in_addr by{};
  std::memcpy(&by, interface.bytes.data(), sizeof by);
  return ::setsockopt(socket, IPPROTO_IP, IP_MULTICAST_IF, &by, sizeof by) == 0 &&
         ::setsockopt(socket, IPPROTO_IP, IP_MULTICAST_TTL, &ttl, sizeof ttl) == 0;
}

}  // namespace

UdpSender::UdpSender(const Address& to, const Address& interface, int ttl)
    : to_(to), socket_(socket_of(to.family, SOCK_DGRAM)) {
  if (socket_.is_open() && (!to.multicast() || send_group(socket_.get(), to, interface, ttl))) return;
  const std::string why = std::strerror(errno);
  throw UserError("cannot send to " + text_of(to) + " by the interface " + host_of(interface) + ": " + why +
                  "; allowed: the address of an interface of this machine");
}

UdpSender::Outcome UdpSender::send(std::span<const std::byte> datagram) {
  if (datagram.size() > kMostBytes) return Outcome::too_long;
  if (!connected_) {  // a connected socket is told what is refused
    const SocketAddress address(to_);
    connected_ = ::connect(socket_.get(), address.data(), address.size()) == 0;
    if (!connected_) return Outcome::unreachable;
  }
  // The refusal of an earlier datagram is told in place of sending this one.
  for (int attempt = 0; attempt < 2; ++attempt) {
    if (::send(socket_.get(), datagram.data(), datagram.size(), MSG_NOSIGNAL) >= 0) return Outcome::sent;
    if (errno != ECONNREFUSED) break;
    ++refused_;
  }
  switch (errno) {
    case EAGAIN:
    case ENOBUFS:
    case EINTR: return Outcome::busy;
    case EMSGSIZE: return Outcome::too_long;
    default: return Outcome::unreachable;
  }
}

}  // namespace ensonify
