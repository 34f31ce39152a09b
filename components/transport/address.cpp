#include "components/transport/address.h"

#include <arpa/inet.h>
#include <net/if.h>
#include <netinet/in.h>

#include <algorithm>
#include <charconv>
#include <optional>

#include "components/errors/exit_error.h"
#include "components/errors/printable.h"

namespace ensonify {
namespace {

constexpr std::array<std::uint8_t, 4> kThisMachine{127, 0, 0, 1}, kEverybody{255, 255, 255, 255};

bool begins_with(const Address& address, const std::array<std::uint8_t, 4>& bytes) {
  return std::equal(bytes.begin(), bytes.end(), address.bytes.begin());
}

std::string without_brackets(const std::string& host) {
  const bool has = host.size() > 2 && host.front() == '[' && host.back() == ']';
  return has ? host.substr(1, host.size() - 2) : host;
}

std::optional<Address> read_host(const std::string& text) {
  Address found;
  if (text == "localhost") {
    std::copy(kThisMachine.begin(), kThisMachine.end(), found.bytes.begin());
    return found;
  }
  if (::inet_pton(AF_INET, text.c_str(), found.bytes.data()) == 1) return found;
  const std::string host = without_brackets(text);
  const std::size_t percent = host.find('%');
  found.family = Address::Family::kIpv6;
  if (::inet_pton(AF_INET6, host.substr(0, percent).c_str(), found.bytes.data()) != 1) return std::nullopt;
  if (percent == std::string::npos) return found;
  found.interface = ::if_nametoindex(host.substr(percent + 1).c_str());
  return found.interface != 0 ? std::optional(found) : std::nullopt;
}

std::optional<std::uint16_t> port_of(const std::string& text) {
  std::uint16_t port = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), port);
  if (error != std::errc{} || end != text.data() + text.size() || port == 0) return std::nullopt;
  return port;
}

[[noreturn]] void refuse_host(const std::string& host) {
  throw UserError("\"" + printable(host) +
                  "\" is no host; allowed: an IPv4 address as 192.168.1.20 or 239.1.2.3, an IPv6 one as [fd00::1] or "
                  "[fe80::1%eth0] with an interface of this machine, or localhost");
}

}  // namespace

bool Address::multicast() const { return family == Family::kIpv4 ? bytes[0] >> 4U == 0xE : bytes[0] == 0xFF; }

bool Address::any() const {
  return std::ranges::all_of(bytes, [](std::uint8_t byte) { return byte == 0; });
}

Address host_address(const std::string& host, int port) {
  const auto found = read_host(host);
  if (!found) {
    throw UserError("\"" + printable(host) +
                    "\" is no address; allowed: one such as 127.0.0.1, ::1, or fe80::1%eth0 with an interface of this "
                    "machine");
  }
  Address address = *found;
  address.port = static_cast<std::uint16_t>(port);
  return address;
}

Address receiver_address(const std::string& host, int port) {
  auto found = read_host(host);
  const bool broadcast = found && found->family == Address::Family::kIpv4 && begins_with(*found, kEverybody);
  if (!found || found->any() || broadcast) refuse_host(host);
  found->port = static_cast<std::uint16_t>(port);
  return *found;
}

Address udp_address(const std::string& text) {
  const std::size_t colon = text.rfind(':');
  const std::string host = colon == std::string::npos ? "localhost" : text.substr(0, colon);
  const std::string port = colon == std::string::npos ? text : text.substr(colon + 1);
  const bool bare = host.find(':') != std::string::npos && without_brackets(host) == host;
  if (bare) refuse_host(host);  // where its port begins is not clear
  Address address = receiver_address(host, 0);
  const auto number = port_of(port);
  if (!number) throw UserError("\"" + printable(port) + "\" is no port; allowed: 1 to 65535, as in 127.0.0.1:16101");
  address.port = *number;
  return address;
}

Address interface_address(const std::string& host) {
  const auto address = read_host(host);
  if (!address || address->any() || address->multicast() || address->family != Address::Family::kIpv4) {
    throw UserError("\"" + printable(host) +
                    "\" is no address of an interface; allowed: its IPv4 address as 192.168.1.10, or localhost; groups "
                    "of IPv6 name it themselves, as [ff02::1%eth0]");
  }
  return *address;
}

std::string host_of(const Address& address) {
  const bool six = address.family == Address::Family::kIpv6;
  std::array<char, INET6_ADDRSTRLEN> text{};
  ::inet_ntop(six ? AF_INET6 : AF_INET, address.bytes.data(), text.data(), text.size());
  if (!six) return text.data();
  std::array<char, IF_NAMESIZE> name{};
  const bool named = address.interface != 0 && ::if_indextoname(address.interface, name.data()) != nullptr;
  return std::string("[") + text.data() + (named ? std::string("%") + name.data() : "") + "]";
}

std::string text_of(const Address& address) { return host_of(address) + ":" + std::to_string(address.port); }

}  // namespace ensonify
