#pragma once

#include <cstdint>
#include <optional>

#include "components/formats/bytes.h"
#include "components/formats/motion.h"
#include "components/formats/stream/frames.h"

/// Attitude as motion sensors send it to Kongsberg echo sounders, the formats of EM 3000 and of the older EM 1000: ten
/// bytes, little endian, with neither time nor checksum [Kongsberg850160692]. They differ in the first byte only.
namespace ensonify::formats::em_attitude {

struct Sample {
  Motion motion;            // usable: status 0 (EM 1000), 0x90 or, reduced, up to 0x99
  std::uint8_t status = 0;  // 0: EM 1000, which has none; 0x9A to 0x9F: not valid; from 0xA0 on: an error
};

/// Only the two bytes in front and the ranges of the values mark a frame: behind garbage one counts when another stands
/// right behind it.
struct Format {
  static constexpr std::size_t kMostBytes = 10;
  Front front(ByteView bytes, bool behind_a_frame) const;
};
using Stream = Frames<Format>;

/// Of a frame's ten bytes; nothing where a value cannot be.
std::optional<Sample> read(ByteView frame);

}  // namespace ensonify::formats::em_attitude
