#include "components/formats/kmall/frame.h"

#include <algorithm>

#include "components/formats/bytes.h"

namespace ensonify::formats::kmall {

namespace {

constexpr std::byte kMark{'#'};

bool is_type(ByteView type) {
  return type[0] == kMark && std::all_of(type.begin() + 1, type.end(), [](std::byte byte) {
           const char letter = static_cast<char>(byte);
           return (letter >= 'A' && letter <= 'Z') || (letter >= '0' && letter <= '9');
         });
}

}  // namespace

FrameCheck FrameFormat::check(Window& file, std::uint64_t offset) {
  const ByteView head = file.at(offset, kLeastLength);
  if (head.size() < kLeastLength) {
    return {.what = "the number of bytes left", .found = head.size(), .rule = "24 at least, or 0"};
  }
  const auto length = ByteSource(head).number<std::uint32_t>();
  const auto type = ByteSource(head.subspan(kLengthBytes)).number<std::uint32_t>();
  if (!is_type(head.subspan(kLengthBytes, kTypeBytes))) {
    return {.what = "the type", .found = type, .rule = "# and three capital letters or digits, as #MRZ"};
  }
  if (length < kLeastLength || length > kMostLength) {
    return {.what = "the length", .found = length, .allowed = kLeastLength, .most = kMostLength};
  }
  if (length > file.size() - offset) {
    return {.what = "the length", .found = length, .rule = "at most what is left of the file"};
  }
  const ByteView trailer = file.peek(offset + length - kLengthBytes, kLengthBytes);
  const auto again = ByteSource(trailer).number<std::uint32_t>();
  if (again != length) return {.what = "the length at the end", .found = again, .allowed = length, .claimed = length};
  return {.bytes = length};
}

std::uint64_t FrameFormat::next_start(Window& file, std::uint64_t from) {
  return next_byte(file, from + kLengthBytes, kMark, kLengthBytes);
}

}  // namespace ensonify::formats::kmall
