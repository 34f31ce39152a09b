#pragma once

#include <cstdint>
#include <string>

namespace ensonify {

/// An IPv4 address, and a port where it has one.
struct UdpAddress {
  std::uint32_t ip = 0;  // 127.0.0.1 is 0x7F000001
  std::uint16_t port = 0;

  bool multicast() const { return (ip >> 28U) == 0xE; }
  bool operator==(const UdpAddress&) const = default;
};

/// Of "192.168.1.20:16101"; localhost is 127.0.0.1, and so is a port alone. Throws UserError with what is allowed.
UdpAddress udp_address(const std::string& text);

/// Of "192.168.1.20" or localhost, an interface's. Throws UserError with what is allowed.
UdpAddress interface_address(const std::string& text);

/// "192.168.1.20".
std::string host_of(const UdpAddress& address);

/// "192.168.1.20:16101".
std::string text_of(const UdpAddress& address);

}  // namespace ensonify
