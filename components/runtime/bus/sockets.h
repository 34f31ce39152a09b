#pragma once

#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>
#include <zmq.hpp>

#include "components/runtime/bus/link.h"
#include "messages/codec.h"

namespace ensonify::bus {

inline constexpr int kReconnectMs = 5;
inline constexpr int kLingerMs = 1000;         // a leaving process hands over what it has sent
inline constexpr int kKernelBuffer = 1 << 20;  // fewer switches between processes for multi-megabyte messages

/// Binds and returns the endpoint to connect to. Throws UserError when the address is taken, is beyond the loopback
/// interface without keys, or a socket path is longer than the system's 107 bytes.
std::string bind_to(zmq::socket_t& socket, const Address& address, const std::string& name);

/// Makes an XPUB the live plane of a process: a tiny queue, nothing is waited for. Binds it and returns its endpoint.
std::string bind_live(zmq::socket_t& socket, const Address& address, const std::string& process);

/// Topics that the subscribers of an XPUB have requested, so that what has no subscriber need not be sent.
class Subscribers {
 public:
  /// Reads what they have said since the last call; returns what is asked for now and was not before.
  std::vector<std::string> read(zmq::socket_t& xpub);
  bool empty() const { return prefixes_.empty(); }
  bool has_subscriber(const std::string& topic) const;

 private:
  std::set<std::string> prefixes_;  // of frame 0: a topic with the NUL that ends it, or less
};

/// Options and connect of a DEALER to the clock.
void connect_control(zmq::socket_t& dealer, const std::string& endpoint, const std::optional<Keys>& keys);

/// A packet as ZeroMQ frames. Large buffers are not copied: the frame keeps their owner alive.
std::vector<zmq::message_t> to_frames(const msg::Packet& packet);

/// Receives one multipart message; false if the socket had none (only with dontwait).
bool receive_frames(zmq::socket_t& socket, std::vector<zmq::message_t>& frames, bool wait = true);

/// Frames as a packet whose buffers are the frames. Throws msg::DecodeError if they are not one.
msg::Packet to_packet(std::vector<zmq::message_t>&& frames);

/// Sends all frames as one message, sharing their content so that they can be sent again.
void send_frames(zmq::socket_t& socket, std::vector<zmq::message_t>& frames);

}  // namespace ensonify::bus
