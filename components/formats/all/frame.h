#pragma once

#include <cstdint>

#include "components/formats/frame_walk.h"

namespace ensonify::formats::all {

/// The frame of a datagram: length (4 bytes, not counting itself), 02h, type, header, body, 03h, checksum. The checksum
/// is the sum of all bytes between 02h and 03h, modulo 65536. On the network the length is not sent.
struct FrameFormat {
  static constexpr std::uint64_t kLengthBytes = 4;
  static constexpr std::uint64_t kTypeBytes = 2;     // 02h and the type
  static constexpr std::uint64_t kTrailerBytes = 3;  // 03h and the checksum
  static constexpr std::byte kStart{0x02};
  static constexpr std::byte kEnd{0x03};
  static constexpr std::uint64_t kLeastLength = 19;        // an empty body
  static constexpr std::uint64_t kMostLength = 1U << 20U;  // sixteen times what the network carries

  static FrameCheck check(Window& file, std::uint64_t offset);
  static std::uint64_t next_start(Window& file, std::uint64_t from);
};

/// Of the bytes between 02h and 03h.
std::uint16_t checksum(ByteView bytes);

}  // namespace ensonify::formats::all
