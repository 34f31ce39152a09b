#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "components/transport/address.h"
#include "components/transport/descriptor.h"
#include "components/transport/sender.h"

namespace ensonify {

/// Sends datagrams to one receiver or one group.
class UdpSender : public Sender {
 public:
  static constexpr std::size_t kMostBytes = 65'507;  // of a datagram of IPv4

  /// A group is sent to over `ttl` routers at most; 1: none. One of IPv4 by the interface of that address, one of IPv6
  /// by the interface that it names, or the one that the machine takes. Throws UserError where this machine has no such
  /// interface.
  UdpSender(const Address& to, const Address& interface, int ttl);
  Outcome send(std::span<const std::byte> datagram) override;

 private:
  Address to_;
  Descriptor socket_;
  bool connected_ = false;
};

}  // namespace ensonify
