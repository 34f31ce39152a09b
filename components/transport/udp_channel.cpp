#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

#include "components/errors/exit_error.h"
#include "components/transport/channel.h"
#include "components/transport/descriptor.h"

namespace ensonify {

Senders::Senders(const std::vector<std::string>& addresses) {
  for (const std::string& address : addresses) allowed_.push_back(ipv4(address, 0).sin_addr.s_addr);
}

bool Senders::allow(std::uint32_t ipv4_network_order) const {
  return std::find(allowed_.begin(), allowed_.end(), ipv4_network_order) != allowed_.end();
}

namespace {

class UdpChannel : public Channel {
 public:
  UdpChannel(const std::string& address, int port, const Senders& senders)
      : senders_(senders), socket_(::socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)) {
    const sockaddr_in own = ipv4(address, port);
    if (!socket_.is_open() || ::bind(socket_.get(), reinterpret_cast<const sockaddr*>(&own), sizeof own) != 0) {
      throw UserError("cannot listen to UDP port " + std::to_string(port) + " of " + address + ": " +
                      std::strerror(errno) + "; allowed: a port that is free");
    }
  }

  std::optional<Piece> wait(std::chrono::milliseconds limit) override {
    if (!comes_within(socket_, POLLIN, limit)) return std::nullopt;
    std::array<char, 65536> buffer;  // no datagram is longer
    sockaddr_in sender{};
    socklen_t length = sizeof sender;
    const ssize_t got =
        ::recvfrom(socket_.get(), buffer.data(), buffer.size(), 0, reinterpret_cast<sockaddr*>(&sender), &length);
    if (got < 0) return std::nullopt;
    if (!senders_.allow(sender.sin_addr.s_addr)) {
      ++refused_;
      return std::nullopt;
    }
    return Piece{std::string(buffer.data(), static_cast<std::size_t>(got)), false, true};
  }

 private:
  Senders senders_;
  Descriptor socket_;
};

}  // namespace

std::unique_ptr<Channel> udp_channel(const std::string& address, int port, const Senders& senders) {
  return std::make_unique<UdpChannel>(address, port, senders);
}

}  // namespace ensonify
