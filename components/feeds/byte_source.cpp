#include "components/feeds/byte_source.h"

#include <optional>

#include "components/config/config_reader.h"
#include "components/errors/exit_error.h"
#include "components/transport/address.h"

namespace ensonify {

void ByteSource::check(const ConfigReader& from) const {
  const auto read = [&](const char* key, const auto& parse) -> std::optional<Address> {
    try {
      return parse();
    } catch (const UserError& error) {
      from.problem(key, error.what());
      return std::nullopt;
    }
  };
  if (const auto* client = std::get_if<TcpClient>(&way))
    read("of", [&] { return receiver_address(client->address, client->port); });
  const auto here = read("at", [&] { return host_address(at); });
  bool some = false, all = true;
  for (const std::string& sender : senders) {
    const auto found = read("senders", [&] { return host_address(sender); });
    some = some || (here && found && found->family == here->family);
    all = all && found;
  }
  const bool receives = std::holds_alternative<Udp>(way) || std::holds_alternative<TcpServer>(way);
  if (!receives || !here || !all || some) return;
  from.problem("senders",
               std::string("none may send to ") + host_of(*here) + "; allowed: at least one " +
                   (here->family == Address::Family::kIpv6 ? "IPv6 address as ::1" : "IPv4 address as 127.0.0.1"));
}

}  // namespace ensonify
