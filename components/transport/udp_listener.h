#pragma once

#include <optional>
#include <string>

namespace ensonify {

/// A UDP port of the loopback interface: nobody outside this machine can send to it.
class UdpListener {
 public:
  /// Throws UserError when the port is taken.
  explicit UdpListener(int port);
  ~UdpListener();
  UdpListener(const UdpListener&) = delete;
  UdpListener& operator=(const UdpListener&) = delete;

  /// The next datagram that has arrived; nothing when none has. Does not wait.
  std::optional<std::string> take();

 private:
  int socket_;
};

}  // namespace ensonify
