#pragma once

#include <optional>
#include <vector>
#include <zmq.hpp>

#include "messages/codec.h"

namespace ensonify::bus {

/// A packet as ZeroMQ frames. Large buffers are not copied: the frame keeps their owner alive.
std::vector<zmq::message_t> to_frames(const msg::Packet& packet);

/// Receives one multipart message; false if the socket had none (only with dontwait).
bool receive_frames(zmq::socket_t& socket, std::vector<zmq::message_t>& frames, bool wait = true);

/// Frames as a packet whose buffers are the frames. Throws msg::DecodeError if they are not one.
msg::Packet to_packet(std::vector<zmq::message_t>&& frames);

/// Sends all frames as one message, sharing their content so that they can be sent again.
void send_frames(zmq::socket_t& socket, std::vector<zmq::message_t>& frames);

}  // namespace ensonify::bus
