#pragma once

#include <netinet/in.h>
#include <sys/socket.h>

#include "components/transport/address.h"
#include "components/transport/descriptor.h"

namespace ensonify {

/// An address as sockets take it, or, made of nothing, room for one that they give.
class SocketAddress {
 public:
  SocketAddress() = default;
  explicit SocketAddress(const Address& address);

  sockaddr* data() { return reinterpret_cast<sockaddr*>(&storage_); }
  const sockaddr* data() const { return reinterpret_cast<const sockaddr*>(&storage_); }
  socklen_t size() const { return size_; }
  socklen_t* size_given() { return &size_; }

  Address address() const;

 private:
  sockaddr_storage storage_{};
  socklen_t size_ = sizeof storage_;
};

/// A socket for addresses of that family, which does not wait. One of IPv6 takes nothing of IPv4. Not open, and errno,
/// where the machine has no such family.
Descriptor socket_of(Address::Family family, int type);

}  // namespace ensonify
