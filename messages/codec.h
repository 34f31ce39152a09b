#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "messages/envelope.h"
#include "messages/fields.h"

namespace ensonify::msg {

/// Frames 2..n of a message: the msgpack map, then the arrays it describes.
struct Body {
  Buffer map;
  std::vector<Buffer> arrays;

  std::size_t size() const;
};

/// A message as it travels: topic, envelope, body and, behind them, facts about wall time that no digest sees.
struct Packet {
  std::string topic;
  Envelope envelope;
  Body body;
  Buffer wall_facts;  // empty unless kFlagWallFacts
};

inline constexpr std::size_t kFirstArrayFrame = 3;
inline constexpr std::size_t kMaxDepth = 16;
inline constexpr std::size_t kMaxMapBytes = 1 << 20;
inline constexpr std::size_t kMaxValues = 1
                                          << 14;  // numbers, texts, lists and maps of one message, arrays counting one
inline constexpr std::size_t kMaxKeys = 512;      // of one map

/// Arrays become frames without a copy; everything else goes into the map.
Body encode_value(const Value& message);
/// Throws DecodeError unless `body` is a well-formed message of at most `max_bytes`. Arrays are views of the frames.
Value decode_value(const Body& body, std::size_t max_bytes);

/// The same map with each array inside it (descriptor key `data` instead of `frame`): a record's payload.
Buffer encode_inline(const Body& body);
/// The reverse of encode_inline; arrays are views of `payload`.
Value decode_inline(const Buffer& payload);

template <HasFields M>
Body encode(const M& message) {
  return encode_value(to_value(message));
}

template <HasFields M>
M decode(const Body& body, std::size_t max_bytes) {
  M message;
  from_value(decode_value(body, max_bytes), message, "");
  return message;
}

}  // namespace ensonify::msg
