#include "components/transport/udp_sender.h"

#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "components/errors/exit_error.h"

namespace ensonify {

namespace {

/// Whether the group's datagrams now leave by that interface.
bool send_group(int socket, const UdpAddress& interface, int ttl) {
  const in_addr by{htonl(interface.ip)};
  return ::setsockopt(socket, IPPROTO_IP, IP_MULTICAST_IF, &by, sizeof by) == 0 &&
         ::setsockopt(socket, IPPROTO_IP, IP_MULTICAST_TTL, &ttl, sizeof ttl) == 0;
}

}  // namespace

UdpSender::UdpSender(const UdpAddress& to, const UdpAddress& interface, int ttl)
    : to_(to), socket_(::socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)) {
  if (socket_ >= 0 && (!to.multicast() || send_group(socket_, interface, ttl))) return;
  const std::string why = std::strerror(errno);
  if (socket_ >= 0) ::close(socket_);
  throw UserError("cannot send to " + text_of(to) + " by the interface " + host_of(interface) + ": " + why +
                  "; allowed: the address of an interface of this machine");
}

UdpSender::~UdpSender() { ::close(socket_); }

UdpSender::Outcome UdpSender::send(std::span<const std::byte> datagram) {
  if (datagram.size() > kMostBytes) return Outcome::too_long;
  if (!connected_) {  // a connected socket is told what is refused
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(to_.port);
    address.sin_addr.s_addr = htonl(to_.ip);
    connected_ = ::connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
    if (!connected_) return Outcome::unreachable;
  }
  // The refusal of an earlier datagram is told in place of sending this one.
  for (int attempt = 0; attempt < 2; ++attempt) {
    if (::send(socket_, datagram.data(), datagram.size(), MSG_NOSIGNAL) >= 0) return Outcome::sent;
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
