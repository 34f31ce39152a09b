#include <poll.h>

#include <algorithm>
#include <thread>
#include <utility>

#include "components/transport/channel.h"
#include "components/transport/descriptor.h"
#include "components/transport/tcp.h"

namespace ensonify {
namespace {

/// What both ends have: one connection, or none.
class TcpChannel : public Channel {
 public:
  std::optional<Piece> wait(std::chrono::milliseconds limit) override {
    if (!connection_.is_open() && !connect(limit)) return std::nullopt;
    if (!comes_within(connection_, POLLIN, limit)) return std::nullopt;
    auto bytes = read_some(connection_);
    if (!bytes) {
      connection_.reset();
      trouble_ = no_connection();
      return std::nullopt;
    }
    if (bytes->empty()) return std::nullopt;
    return Piece{std::move(*bytes), std::exchange(begins_, false), false};
  }

 protected:
  /// Whether connection_ is open now.
  virtual bool connect(std::chrono::milliseconds limit) = 0;
  virtual std::string no_connection() const = 0;
  bool connected(Descriptor connection) {
    connection_ = std::move(connection);
    begins_ = true;
    trouble_.clear();
    return true;
  }

  Descriptor connection_;

 private:
  bool begins_ = true;
};

class TcpClient : public TcpChannel {
 public:
  TcpClient(const std::string& address, int port) : other_(receiver_address(address, port)) {
    trouble_ = no_connection();
  }

 private:
  bool connect(std::chrono::milliseconds limit) override {
    const auto now = std::chrono::steady_clock::now();
    if (now < next_try_) {
      std::this_thread::sleep_for(std::min<std::chrono::nanoseconds>(limit, next_try_ - now));
      return false;
    }
    next_try_ = now + tcp::kTryAgain;
    Descriptor trying = tcp::connect(other_, limit);
    if (!trying.is_open()) return false;
    return connected(std::move(trying));
  }
  std::string no_connection() const override { return "no connection to " + text_of(other_); }

  Address other_;
  std::chrono::steady_clock::time_point next_try_{};
};

/// One sender at a time: a second one is refused while the first is there.
class TcpServer : public TcpChannel {
 public:
  TcpServer(const std::string& address, int port, const Senders& senders)
      : senders_(senders), port_(port), listener_(tcp::listener(address, port)) {
    trouble_ = no_connection();
  }

  std::optional<Piece> wait(std::chrono::milliseconds limit) override {
    if (connection_.is_open()) {
      while (tcp::accept(listener_, senders_).connection.is_open()) ++refused_;
    }
    return TcpChannel::wait(limit);
  }

 private:
  bool connect(std::chrono::milliseconds limit) override {
    if (!comes_within(listener_, POLLIN, limit)) return false;
    tcp::Accepted accepted = tcp::accept(listener_, senders_);
    if (accepted.allowed) return connected(std::move(accepted.connection));
    if (!accepted.connection.is_open()) return false;
    ++refused_;
    return false;
  }
  std::string no_connection() const override { return "nobody is connected to TCP port " + std::to_string(port_); }

  Senders senders_;
  int port_;
  Descriptor listener_;
};

}  // namespace

std::unique_ptr<Channel> tcp_server_channel(const std::string& address, int port, const Senders& senders) {
  return std::make_unique<TcpServer>(address, port, senders);
}

std::unique_ptr<Channel> tcp_client_channel(const std::string& address, int port) {
  return std::make_unique<TcpClient>(address, port);
}

}  // namespace ensonify
