#pragma once

#include <cstddef>
#include <vector>

#include "messages/codec.h"

namespace ensonify::console {

/// A message as one WebSocket message, in parts that are sent one behind the other (docs/manual/console-wire.md): the
/// envelope (64 bytes), the lengths of topic and map (two numbers of 32 bits, little endian), topic, map, arrays. Each
/// of them is filled up with zeros to a multiple of 8 bytes. The parts share the packet's memory.
std::vector<msg::Buffer> frame_of(const msg::Packet& packet);

/// Their length together.
std::size_t size_of(const std::vector<msg::Buffer>& parts);

}  // namespace ensonify::console
