#pragma once

#include <cstdint>

#include "components/formats/frame_walk.h"

namespace ensonify::formats::kmall {

/// The frame of a datagram: length (4 bytes; of the whole frame), four characters of which the first is '#', header,
/// body, and the length again. There is no checksum: what changes within a body goes unnoticed.
struct FrameFormat {
  static constexpr std::uint64_t kLengthBytes = 4;
  static constexpr std::uint64_t kTypeBytes = 4;
  static constexpr std::uint64_t kHeadBytes = 20;
  static constexpr std::uint64_t kLeastLength = kHeadBytes + kLengthBytes;  // an empty body
  static constexpr std::uint64_t kMostLength = 64U << 20U;                  // water columns are a few megabytes

  static FrameCheck check(Window& file, std::uint64_t offset);
  static std::uint64_t next_start(Window& file, std::uint64_t from);
};

}  // namespace ensonify::formats::kmall
