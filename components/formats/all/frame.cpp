#include "components/formats/all/frame.h"

#include <numeric>

#include "components/formats/all/header.h"
#include "components/formats/layout.h"
#include "components/formats/utc.h"

namespace ensonify::formats::all {

std::uint16_t checksum(ByteView bytes) {
  return std::accumulate(bytes.begin(), bytes.end(), std::uint16_t{0}, [](std::uint16_t sum, std::byte byte) {
    return static_cast<std::uint16_t>(sum + std::to_integer<std::uint16_t>(byte));
  });
}

FrameCheck FrameFormat::check(Window& file, std::uint64_t offset) {
  const std::uint64_t left = file.size() - std::min(offset, file.size());
  if (left < kLengthBytes + kLeastLength) {
    return {.what = "the number of bytes left", .found = left, .rule = "23 at least, or 0"};
  }
  const ByteView head = file.at(offset, kLengthBytes + kLeastLength);
  LayoutReader in(head);
  std::uint32_t length = 0;
  std::uint8_t start = 0, type = 0;
  Header header;
  in(length, start, type, header);
  if (in.failed()) return {.what = "the number of bytes left", .found = head.size(), .rule = "23 at least, or 0"};
  if (std::byte{start} != kStart) {
    return {.what = "the start mark", .found = start, .allowed = 2};
  }
  if (length < kLeastLength || length > kMostLength) {
    return {.what = "the length", .found = length, .allowed = kLeastLength, .most = kMostLength};
  }
  const std::uint64_t bytes = kLengthBytes + length;
  if (bytes > left) {
    return {.what = "the length", .found = length, .rule = "at most what is left of the file"};
  }
  if (!is_date(header.date)) {
    return {.what = "the date", .found = header.date, .rule = "year, month and day as 20171214", .claimed = bytes};
  }
  if (header.time_ms > kDayMs + 1000) {  // a leap second
    return {.what = "the time of day", .found = header.time_ms, .most = kDayMs + 1000, .claimed = bytes};
  }
  // The end mark first: it is one byte, the checksum may be of a megabyte.
  const ByteView end = file.peek(offset + bytes - kTrailerBytes, 1);
  if (end.empty() || end[0] != kEnd) {
    const std::uint64_t found = end.empty() ? 0 : std::to_integer<std::uint64_t>(end[0]);
    return {.what = "the end mark", .found = found, .allowed = 3, .claimed = bytes};
  }
  const ByteView frame = file.at(offset, static_cast<std::size_t>(bytes));
  if (frame.size() < bytes) return {.what = "the number of bytes left", .found = frame.size(), .allowed = bytes};
  const ByteView trailer = frame.last(kTrailerBytes);
  const auto stated = ByteSource(trailer.last(2)).number<std::uint16_t>();
  const std::uint16_t summed =
      checksum(frame.subspan(kLengthBytes + 1, frame.size() - kLengthBytes - 1 - kTrailerBytes));
  if (stated != summed)
    return {.what = "the checksum", .found = stated, .allowed = summed, .claimed = bytes, .examined = bytes};
  return {.bytes = bytes};
}

std::uint64_t FrameFormat::next_start(Window& file, std::uint64_t from) {
  return next_byte(file, from + kLengthBytes, kStart, kLengthBytes);
}

}  // namespace ensonify::formats::all
