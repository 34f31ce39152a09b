#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "components/transport/address.h"

namespace ensonify {

/// A way by which bytes come in: a UDP port, a TCP connection to or from elsewhere, a serial line. Of one thread.
class Channel {
 public:
  struct Piece {
    std::string bytes;
    bool begins = false;  // the first of a connection: half a sentence before it stays half
    bool whole = false;   // a datagram: nothing in it is continued by the next one
  };

  virtual ~Channel() = default;
  /// Bytes, when some come within the time; a piece is 65,536 bytes at most.
  virtual std::optional<Piece> wait(std::chrono::milliseconds limit) = 0;

  /// Datagrams, connections or bytes that came from others than the ones allowed.
  std::uint64_t refused() const { return refused_; }
  /// Why nothing can come at the moment, "no connection to 10.0.0.7:4001"; "": it can.
  const std::string& trouble() const { return trouble_; }

 protected:
  std::uint64_t refused_ = 0;
  std::string trouble_;
};

/// Addresses of senders, as numbers: "127.0.0.1", "::1". Throws UserError for one that is none.
class Senders {
 public:
  explicit Senders(const std::vector<std::string>& addresses);
  /// Whatever its port.
  bool allow(const Address& sender) const;

 private:
  std::vector<Address> allowed_;
};

// Each throws UserError where it cannot begin: a port that is taken, a line that is not there. A connection that is not
// there yet, or breaks, is tried again every second.
std::unique_ptr<Channel> udp_channel(const std::string& address, int port, const Senders& senders);
std::unique_ptr<Channel> tcp_server_channel(const std::string& address, int port, const Senders& senders);
std::unique_ptr<Channel> tcp_client_channel(const std::string& address, int port);
std::unique_ptr<Channel> serial_channel(const std::string& path, int baud);

}  // namespace ensonify
