#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "components/transport/sender.h"
#include "components/transport/udp_address.h"

namespace ensonify {

/// Sends datagrams to one receiver or one group.
class UdpSender : public Sender {
 public:
  static constexpr std::size_t kMostBytes = 65'507;  // of a datagram of IPv4

  /// A group is sent to by the interface of that address, over `ttl` routers at most; 1: none. Throws UserError where
  /// this machine has no such interface.
  UdpSender(const UdpAddress& to, const UdpAddress& interface, int ttl);
  ~UdpSender() override;
  UdpSender(const UdpSender&) = delete;
  UdpSender& operator=(const UdpSender&) = delete;

  Outcome send(std::span<const std::byte> datagram) override;

 private:
  UdpAddress to_;
  int socket_;
  bool connected_ = false;
};

}  // namespace ensonify
