#include <sys/socket.h>

#include <algorithm>
#include <vector>

#include "components/transport/outlet.h"
#include "components/transport/sender.h"
#include "components/transport/tcp.h"

namespace ensonify {
namespace {

constexpr std::size_t kMostConnections = 8;
constexpr int kBuffer_bytes = 64 << 10;  // what waits there is old
constexpr std::chrono::milliseconds kPatience{100};

Outlet outlet_of(Descriptor connection) {
  ::setsockopt(connection.get(), SOL_SOCKET, SO_SNDBUF, &kBuffer_bytes, sizeof kBuffer_bytes);
  return Outlet(std::move(connection));
}

class TcpClientSender : public Sender {
 public:
  TcpClientSender(const std::string& address, int port) : other_(receiver_address(address, port)) {}

  Outcome send(std::span<const std::byte> piece) override {
    if (!to_.is_open() && !connect()) return Outcome::unreachable;
    switch (to_.write(piece)) {
      case Outlet::Result::taken: return Outcome::sent;
      case Outlet::Result::busy: return Outcome::busy;
      default: return Outcome::unreachable;
    }
  }

 private:
  bool connect() {
    const auto now = std::chrono::steady_clock::now();
    if (now < next_try_) return false;
    next_try_ = now + tcp::kTryAgain;
    to_ = outlet_of(tcp::connect(other_, kPatience));
    return to_.is_open();
  }

  Address other_;
  Outlet to_;
  std::chrono::steady_clock::time_point next_try_{};
};

class TcpServerSender : public Sender {
 public:
  TcpServerSender(const std::string& address, int port, const Senders& receivers)
      : receivers_(receivers), listener_(tcp::listener(address, port)) {}

  Outcome send(std::span<const std::byte> piece) override {
    take_connections();
    for (Outlet& connection : connections_) {
      if (connection.write(piece) == Outlet::Result::busy) ++refused_;
    }
    std::erase_if(connections_, [](const Outlet& connection) { return !connection.is_open(); });
    return connections_.empty() ? Outcome::unreachable : Outcome::sent;
  }

 private:
  void take_connections() {
    for (;;) {
      tcp::Accepted accepted = tcp::accept(listener_, receivers_);
      if (!accepted.connection.is_open()) return;
      if (accepted.allowed && connections_.size() < kMostConnections)
        connections_.push_back(outlet_of(std::move(accepted.connection)));
      else ++refused_;
    }
  }

  Senders receivers_;
  Descriptor listener_;
  std::vector<Outlet> connections_;
};

}  // namespace

std::unique_ptr<Sender> tcp_server_sender(const std::string& address, int port, const Senders& receivers) {
  return std::make_unique<TcpServerSender>(address, port, receivers);
}

std::unique_ptr<Sender> tcp_client_sender(const std::string& address, int port) {
  return std::make_unique<TcpClientSender>(address, port);
}

}  // namespace ensonify
