#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>

#include <cerrno>
#include <cstring>
#include <thread>
#include <utility>

#include "components/errors/exit_error.h"
#include "components/transport/channel.h"
#include "components/transport/descriptor.h"

namespace ensonify {
namespace {

constexpr std::chrono::seconds kTryAgain{1};

Descriptor tcp_socket() { return Descriptor(::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)); }

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
  TcpClient(const std::string& address, int port) : address_(address), port_(port) {
    ipv4(address, port);  // throws
    trouble_ = no_connection();
  }

 private:
  bool connect(std::chrono::milliseconds limit) override {
    const auto now = std::chrono::steady_clock::now();
    if (now < next_try_) {
      std::this_thread::sleep_for(std::min<std::chrono::nanoseconds>(limit, next_try_ - now));
      return false;
    }
    next_try_ = now + kTryAgain;
    Descriptor trying = tcp_socket();
    const sockaddr_in other = ipv4(address_, port_);
    if (::connect(trying.get(), reinterpret_cast<const sockaddr*>(&other), sizeof other) != 0) {
      if (errno != EINPROGRESS || !comes_within(trying, POLLOUT, limit)) return false;
      int error = 0;
      socklen_t length = sizeof error;
      if (::getsockopt(trying.get(), SOL_SOCKET, SO_ERROR, &error, &length) != 0 || error != 0) return false;
    }
    return connected(std::move(trying));
  }
  std::string no_connection() const override { return "no connection to " + place_of(address_, port_); }

  std::string address_;
  int port_;
  std::chrono::steady_clock::time_point next_try_{};
};

/// One sender at a time: a second one is refused while the first is there.
class TcpServer : public TcpChannel {
 public:
  TcpServer(const std::string& address, int port, const Senders& senders)
      : senders_(senders), port_(port), listener_(tcp_socket()) {
    const sockaddr_in own = ipv4(address, port);
    const int yes = 1;
    ::setsockopt(listener_.get(), SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    if (!listener_.is_open() || ::bind(listener_.get(), reinterpret_cast<const sockaddr*>(&own), sizeof own) != 0 ||
        ::listen(listener_.get(), 4) != 0) {
      throw UserError("cannot listen to TCP port " + std::to_string(port) + " of " + address + ": " +
                      std::strerror(errno) + "; allowed: a port that is free");
    }
    trouble_ = no_connection();
  }

  std::optional<Piece> wait(std::chrono::milliseconds limit) override {
    if (connection_.is_open()) {
      while (Descriptor(::accept4(listener_.get(), nullptr, nullptr, SOCK_CLOEXEC)).is_open()) ++refused_;
    }
    return TcpChannel::wait(limit);
  }

 private:
  bool connect(std::chrono::milliseconds limit) override {
    if (!comes_within(listener_, POLLIN, limit)) return false;
    sockaddr_in sender{};
    socklen_t length = sizeof sender;
    Descriptor accepted(
        ::accept4(listener_.get(), reinterpret_cast<sockaddr*>(&sender), &length, SOCK_NONBLOCK | SOCK_CLOEXEC));
    if (!accepted.is_open()) return false;
    if (senders_.allow(sender.sin_addr.s_addr)) return connected(std::move(accepted));
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
