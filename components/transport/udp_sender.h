#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "components/transport/udp_address.h"

namespace ensonify {

/// Sends datagrams to one receiver or one group. It does not wait, and a receiver that is not there is no error: what
/// it refuses is counted.
class UdpSender {
 public:
  static constexpr std::size_t kMostBytes = 65'507;  // of a datagram of IPv4

  enum class Outcome {
    sent,         // the network has it: UDP knows no more
    busy,         // not now: the socket's buffer is full
    unreachable,  // no way to there at present
    too_long,
  };

  /// A group is sent to by the interface of that address, over `ttl` routers at most; 1: none. Throws UserError where
  /// this machine has no such interface.
  UdpSender(const UdpAddress& to, const UdpAddress& interface, int ttl);
  ~UdpSender();
  UdpSender(const UdpSender&) = delete;
  UdpSender& operator=(const UdpSender&) = delete;

  Outcome send(std::span<const std::byte> datagram);
  /// Datagrams for which the receiver's machine said that nobody reads there.
  std::int64_t refused() const { return refused_; }

 private:
  UdpAddress to_;
  int socket_;
  bool connected_ = false;
  std::int64_t refused_ = 0;
};

}  // namespace ensonify
