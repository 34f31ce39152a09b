#pragma once

#include <array>
#include <cstdint>
#include <string>

namespace ensonify {

/// An address of a machine, IPv4 or IPv6, and a port where it has one.
struct Address {
  enum class Family { kIpv4, kIpv6 };

  Family family = Family::kIpv4;
  std::array<std::uint8_t, 16> bytes{};  // as on the wire; of IPv4 the first four
  std::uint32_t interface = 0;           // of an IPv6 address that names one, "fe80::1%eth0": its index; 0: none
  std::uint16_t port = 0;

  bool multicast() const;
  /// 0.0.0.0 or ::.
  bool any() const;
  bool operator==(const Address&) const = default;
};

// Each throws UserError with what is allowed. Hosts are "192.168.1.20", "::1" or "[::1]", "fe80::1%eth0", or localhost,
// which is 127.0.0.1.

/// An address of this machine or of another one.
Address host_address(const std::string& host, int port = 0);
/// The same, of somebody who can be sent to: no 0.0.0.0.
Address receiver_address(const std::string& host, int port);
/// Of "192.168.1.20:16101" or "[fd00::1]:16101"; a port alone is of 127.0.0.1.
Address udp_address(const std::string& text);
/// An interface's.
Address interface_address(const std::string& host);

/// "192.168.1.20", "[fd00::1]".
std::string host_of(const Address& address);
/// "192.168.1.20:16101", "[fd00::1]:16101".
std::string text_of(const Address& address);

}  // namespace ensonify
