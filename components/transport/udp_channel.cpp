#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

#include "components/errors/exit_error.h"
#include "components/transport/channel.h"
#include "components/transport/socket_address.h"

namespace ensonify {

Senders::Senders(const std::vector<std::string>& addresses) {
  for (const std::string& address : addresses) allowed_.push_back(host_address(address));
}

bool Senders::allow(const Address& sender) const {
  return std::ranges::any_of(allowed_, [&](const Address& one) {
    return one.family == sender.family && one.bytes == sender.bytes &&
           (one.interface == 0 || one.interface == sender.interface);
  });
}

namespace {

class UdpChannel : public Channel {
 public:
  UdpChannel(const std::string& address, int port, const Senders& senders)
      : senders_(senders), socket_(socket_of(host_address(address).family, SOCK_DGRAM)) {
    const SocketAddress own(host_address(address, port));
    if (!socket_.is_open() || ::bind(socket_.get(), own.data(), own.size()) != 0) {
      throw UserError("cannot listen to UDP port " + std::to_string(port) + " of " + address + ": " +
                      std::strerror(errno) + "; allowed: a port that is free");
    }
  }

  std::optional<Piece> wait(std::chrono::milliseconds limit) override {
    if (!comes_within(socket_, POLLIN, limit)) return std::nullopt;
    std::array<char, 65536> buffer;  // no datagram is longer
    SocketAddress sender;
    const ssize_t got = ::recvfrom(socket_.get(), buffer.data(), buffer.size(), 0, sender.data(), sender.size_given());
    if (got < 0) return std::nullopt;
    if (!senders_.allow(sender.address())) {
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
