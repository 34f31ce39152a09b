#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "components/transport/channel.h"

namespace ensonify {

/// A way by which bytes go out: to a UDP port, to those who connect by TCP, over a connection to elsewhere, by a serial
/// line. Of one thread. It does not wait, and a receiver that is not there is no error.
class Sender {
 public:
  enum class Outcome {
    sent,         // the network has it, or the line: more is not known
    busy,         // not now: a buffer is full
    unreachable,  // no way to there at present
    too_long,
  };

  virtual ~Sender() = default;
  /// Takes a piece whole or not at all.
  virtual Outcome send(std::span<const std::byte> piece) = 0;
  /// Pieces that were not taken at the other end: where its machine said that nobody reads there, and where one of
  /// several connections had no room; and connections of those who are not allowed.
  std::int64_t refused() const { return refused_; }

 protected:
  std::int64_t refused_ = 0;
};

// Each throws UserError where it cannot begin: a port that is taken, a line that is not there. A connection that is not
// there yet, or breaks, is tried again every second.
/// To eight connections at most. `receivers` may connect.
std::unique_ptr<Sender> tcp_server_sender(const std::string& address, int port, const Senders& receivers);
std::unique_ptr<Sender> tcp_client_sender(const std::string& address, int port);
std::unique_ptr<Sender> serial_sender(const std::string& path, int baud);

}  // namespace ensonify
