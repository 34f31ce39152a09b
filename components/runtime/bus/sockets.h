#pragma once

#include <string>
#include <zmq.hpp>

#include "components/runtime/bus/link.h"

namespace ensonify::bus {

inline constexpr int kReconnectMs = 5;
inline constexpr int kLingerMs = 1000;         // a leaving process hands over what it has sent
inline constexpr int kKernelBuffer = 1 << 20;  // fewer switches between processes for multi-megabyte messages

/// Binds and returns the endpoint to connect to. Throws UserError when the address is taken, not on the loopback
/// interface, or a socket path is longer than the system's 107 bytes.
std::string bind(zmq::socket_t& socket, const Address& address, const std::string& name);

/// Options and connect of a DEALER to the clock.
void connect_control(zmq::socket_t& dealer, const std::string& endpoint);

}  // namespace ensonify::bus
