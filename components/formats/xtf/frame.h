#pragma once

#include <cstdint>

#include "components/formats/frame_walk.h"

namespace ensonify::formats::xtf {

/// The frame of a packet: FACEh, header, and the length of the whole (4 bytes), which is a multiple of 64. There is no
/// checksum: what changes within a body goes unnoticed.
struct FrameFormat {
  static constexpr std::uint16_t kMagic = 0xFACE;
  static constexpr std::uint64_t kHeadBytes = 14;
  static constexpr std::uint64_t kLengthAt = 10;
  static constexpr std::uint64_t kPadding = 64;
  static constexpr std::uint64_t kMostLength = 64U << 20U;

  static FrameCheck check(Window& file, std::uint64_t offset);
  static std::uint64_t next_start(Window& file, std::uint64_t from);
};

}  // namespace ensonify::formats::xtf
