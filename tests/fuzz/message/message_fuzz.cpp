// Arbitrary bytes as a message: the decoder must refuse them or give a value, within its bounds of memory and depth.
// Input: number of array frames (mod 4), length of the map (u16), the map, then the frames, equal shares of the rest.
#include <algorithm>
#include <cstdint>
#include <cstdlib>

#include "messages/all.h"
#include "messages/codec.h"

using namespace ensonify::msg;

namespace {

Buffer view(const std::uint8_t* data, std::size_t size) {
  return {nullptr, reinterpret_cast<const std::byte*>(data), size};
}

Body body_of(const std::uint8_t* data, std::size_t size) {
  if (size < 3) return {view(data, size), {}};
  const std::size_t frames = data[0] % 4;
  const std::size_t map_size = std::min<std::size_t>(data[1] + 256U * data[2], size - 3);
  Body body{view(data + 3, map_size), {}};
  const std::uint8_t* rest = data + 3 + map_size;
  const std::size_t share = frames ? (size - 3 - map_size) / frames : 0;
  for (std::size_t i = 0; i < frames; ++i) body.arrays.push_back(view(rest + i * share, share));
  return body;
}

void require(bool holds) {
  if (!holds) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const Body body = body_of(data, size);
  try {
    const Value value = decode_value(body, 1 << 20);
    to_json(value);
    // What was accepted survives both ways of storing it.
    const Body again = encode_value(value);
    require(decode_value(again, 1 << 22) == value);
    require(decode_inline(encode_inline(again)) == value);
  } catch (const DecodeError&) {
  }
  for_each_message([&](const auto& example) {
    using M = std::remove_cvref_t<decltype(example)>;
    try {
      decode<M>(body, 1 << 20);
    } catch (const DecodeError&) {
    }
  });
  try {
    decode_inline(view(data, size));
  } catch (const DecodeError&) {
  }
  try {
    decode_envelope(std::as_bytes(std::span(data, size)));
  } catch (const DecodeError&) {
  }
  return 0;
}
