#include "components/runtime/address_list.h"

#include <arpa/inet.h>

#include <algorithm>
#include <charconv>
#include <optional>

#include "components/errors/exit_error.h"

namespace ensonify {

namespace {

std::optional<std::uint32_t> ipv4(const std::string& text) {
  in_addr address{};
  if (::inet_pton(AF_INET, text.c_str(), &address) != 1) return std::nullopt;
  return ntohl(address.s_addr);
}

}  // namespace

bool is_address(const std::string& text) { return ipv4(text).has_value(); }

AddressList::AddressList(const std::vector<std::string>& entries) : entries_(entries) {
  for (const std::string& entry : entries) {
    const std::size_t slash = entry.find('/');
    const auto address = ipv4(entry.substr(0, slash));
    unsigned bits = 32;
    bool good = address.has_value();
    if (good && slash != std::string::npos) {
      const char* end = entry.data() + entry.size();
      const auto [read_to, error] = std::from_chars(entry.data() + slash + 1, end, bits);
      good = error == std::errc{} && read_to == end && bits <= 32;
    }
    if (!good) {
      throw UserError("\"" + entry + "\" is no address; allowed: an IPv4 address such as 10.0.0.2, or 10.0.0.0/24");
    }
    const std::uint32_t mask = bits == 0 ? 0U : ~0U << (32U - bits);
    networks_.push_back({*address & mask, mask});
  }
}

bool AddressList::contains(const std::string& address) const {
  const auto bits = ipv4(address);
  return bits &&
         std::any_of(networks_.begin(), networks_.end(), [&](const Network& n) { return (*bits & n.mask) == n.bits; });
}

}  // namespace ensonify
