#include "components/transport/udp_address.h"

#include <arpa/inet.h>
#include <netinet/in.h>

#include <array>
#include <charconv>
#include <optional>

#include "components/errors/exit_error.h"
#include "components/errors/printable.h"

namespace ensonify {

namespace {

std::optional<std::uint32_t> ip_of(const std::string& host) {
  if (host == "localhost") return INADDR_LOOPBACK;
  in_addr address{};
  if (::inet_pton(AF_INET, host.c_str(), &address) != 1) return std::nullopt;
  return ntohl(address.s_addr);
}

std::optional<std::uint16_t> port_of(const std::string& text) {
  std::uint16_t port = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), port);
  if (error != std::errc{} || end != text.data() + text.size() || port == 0) return std::nullopt;
  return port;
}

}  // namespace

UdpAddress udp_address(const std::string& text) {
  const std::size_t colon = text.rfind(':');
  const std::string host = colon == std::string::npos ? "localhost" : text.substr(0, colon);
  const std::string port = colon == std::string::npos ? text : text.substr(colon + 1);
  const auto ip = ip_of(host);
  if (!ip || *ip == INADDR_ANY || *ip == INADDR_BROADCAST) {
    throw UserError("\"" + printable(host) +
                    "\" is no host; allowed: an IPv4 address as 192.168.1.20 or 239.1.2.3, or localhost");
  }
  const auto number = port_of(port);
  if (!number) throw UserError("\"" + printable(port) + "\" is no port; allowed: 1 to 65535, as in 127.0.0.1:16101");
  return {*ip, *number};
}

UdpAddress interface_address(const std::string& text) {
  const auto ip = ip_of(text);
  if (!ip || *ip == INADDR_ANY || UdpAddress{*ip, 0}.multicast()) {
    throw UserError("\"" + printable(text) +
                    "\" is no address of an interface; allowed: its IPv4 address as 192.168.1.10, or localhost");
  }
  return {*ip, 0};
}

std::string host_of(const UdpAddress& address) {
  const in_addr network{htonl(address.ip)};
  std::array<char, INET_ADDRSTRLEN> text{};
  ::inet_ntop(AF_INET, &network, text.data(), text.size());
  return text.data();
}

std::string text_of(const UdpAddress& address) { return host_of(address) + ":" + std::to_string(address.port); }

}  // namespace ensonify
