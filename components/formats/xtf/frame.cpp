#include "components/formats/xtf/frame.h"

#include <algorithm>

namespace ensonify::formats::xtf {

namespace {

bool is_magic(Window& file, std::uint64_t offset) {
  const ByteView bytes = file.peek(offset, sizeof FrameFormat::kMagic);
  return bytes.size() == sizeof FrameFormat::kMagic && ByteSource(bytes).number<std::uint16_t>() == FrameFormat::kMagic;
}

/// Length of a packet by its own word; 0: it cannot be one.
std::uint64_t stated_length(Window& file, std::uint64_t offset) {
  const ByteView head = file.peek(offset, FrameFormat::kHeadBytes);
  if (head.size() < FrameFormat::kHeadBytes) return 0;
  const auto length = ByteSource(head.subspan(FrameFormat::kLengthAt)).number<std::uint32_t>();
  const bool can_be = length >= FrameFormat::kHeadBytes && length <= FrameFormat::kMostLength;
  return can_be && length <= file.size() - offset ? length : 0;
}

/// A packet, and another or the end of the file behind it.
bool is_followed(Window& file, std::uint64_t offset) {
  const std::uint64_t end = offset + stated_length(file, offset);
  return end > offset && (end == file.size() || is_magic(file, end));
}

/// Whether another packet begins before `end`: the length of this one is wrong. Samples may look like a magic number,
/// one pair of bytes in 65536; what has more of them is no packet either way.
bool holds_a_packet(Window& file, std::uint64_t from, std::uint64_t end) {
  constexpr int kMostLookalikes = 64;
  std::uint64_t start = FrameFormat::next_start(file, from);
  for (int i = 0; i < kMostLookalikes && start < end; ++i) {
    if (is_followed(file, start)) return true;
    start = FrameFormat::next_start(file, start + 1);
  }
  return false;
}

}  // namespace

FrameCheck FrameFormat::check(Window& file, std::uint64_t offset) {
  const std::uint64_t left = file.size() - std::min(offset, file.size());
  const ByteView head = file.at(offset, kHeadBytes);
  if (head.size() < kHeadBytes)
    return {.what = "the number of bytes left", .found = head.size(), .rule = "14 at least, or 0"};
  const auto magic = ByteSource(head).number<std::uint16_t>();
  const auto length = ByteSource(head.subspan(kLengthAt)).number<std::uint32_t>();
  if (magic != kMagic) return {.what = "the magic number", .found = magic, .rule = "64206 (FACEh)"};
  if (length < kHeadBytes || length > kMostLength) {
    return {.what = "the length", .found = length, .allowed = kHeadBytes, .most = kMostLength};
  }
  if (length > left) return {.what = "the length", .found = length, .rule = "at most what is left of the file"};
  if (holds_a_packet(file, offset + kHeadBytes, offset + length)) {
    return {.what = "the length", .found = length, .rule = "that up to the next packet", .examined = length};
  }
  return {.bytes = length};
}

std::uint64_t FrameFormat::next_start(Window& file, std::uint64_t from) {
  constexpr std::byte kFirst{kMagic & 0xFFU};
  std::uint64_t offset = next_byte(file, from, kFirst, 0);
  while (offset < file.size() && !is_magic(file, offset)) offset = next_byte(file, offset + 1, kFirst, 0);
  return offset;
}

}  // namespace ensonify::formats::xtf
