#include "components/transport/socket_address.h"

#include <cstring>

namespace ensonify {

SocketAddress::SocketAddress(const Address& address) {
  if (address.family == Address::Family::kIpv4) {
    sockaddr_in of{};
    of.sin_family = AF_INET;
    of.sin_port = htons(address.port);
    std::memcpy(&of.sin_addr, address.bytes.data(), sizeof of.sin_addr);
    std::memcpy(&storage_, &of, size_ = sizeof of);
  } else {
    sockaddr_in6 of{};
    of.sin6_family = AF_INET6;
    of.sin6_port = htons(address.port);
    of.sin6_scope_id = address.interface;
    std::memcpy(&of.sin6_addr, address.bytes.data(), sizeof of.sin6_addr);
    std::memcpy(&storage_, &of, size_ = sizeof of);
  }
}

Address SocketAddress::address() const {
  Address found;
  if (storage_.ss_family == AF_INET) {
    sockaddr_in of{};
    std::memcpy(&of, &storage_, sizeof of);
    found.port = ntohs(of.sin_port);
    std::memcpy(found.bytes.data(), &of.sin_addr, sizeof of.sin_addr);
  } else {
    sockaddr_in6 of{};
    std::memcpy(&of, &storage_, sizeof of);
    found.family = Address::Family::kIpv6;
    found.port = ntohs(of.sin6_port);
    found.interface = of.sin6_scope_id;
    std::memcpy(found.bytes.data(), &of.sin6_addr, sizeof of.sin6_addr);
  }
  return found;
}

Descriptor socket_of(Address::Family family, int type) {
  const bool six = family == Address::Family::kIpv6;
  Descriptor made(::socket(six ? AF_INET6 : AF_INET, type | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  const int yes = 1;
  if (six && made.is_open()) ::setsockopt(made.get(), IPPROTO_IPV6, IPV6_V6ONLY, &yes, sizeof yes);
  return made;
}

}  // namespace ensonify
