#pragma once

#include <optional>

#include "components/formats/bytes.h"
#include "components/formats/motion.h"
#include "components/formats/stream/frames.h"

/// TSS1 (TSS DMS and many since): 27 characters with CR LF, `:` first; neither time nor checksum.
namespace ensonify::formats::tss1 {

struct Sample {
  Motion motion;  // usable: settled, an upper-case status
  double horizontal_acceleration_mps2 = 0.0;
  double vertical_acceleration_mps2 = 0.0;
  char status = ' ';  // U G H F: unaided, aided by velocity, by heading, by both; lower case: settling
};

struct Format {
  static constexpr std::size_t kMostBytes = 27;
  Front front(ByteView bytes, bool behind_a_frame) const;
};
using Stream = Frames<Format>;

/// Of a frame's 27 bytes; nothing where a field cannot be.
std::optional<Sample> read(ByteView frame);

}  // namespace ensonify::formats::tss1
