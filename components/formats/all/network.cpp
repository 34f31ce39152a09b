#include "components/formats/all/network.h"

#include "components/errors/assert.h"
#include "components/formats/all/frame.h"

namespace ensonify::formats::all {

std::size_t datagram_bytes(ByteView file) {
  const std::size_t bytes = FrameFormat::kLengthBytes + ByteSource(file).number<std::uint32_t>();
  ENSONIFY_ASSERT(bytes <= file.size(), std::to_string(bytes) + " bytes of " + std::to_string(file.size()));
  return bytes;
}

ByteView to_network(ByteView datagram) { return datagram.subspan(FrameFormat::kLengthBytes); }

std::optional<Bytes> from_network(ByteView received) {
  Bytes datagram;
  append_number(datagram, static_cast<std::uint32_t>(received.size()));
  datagram.insert(datagram.end(), received.begin(), received.end());
  Window file{ByteView(datagram)};
  if (FrameFormat::check(file, 0).bytes != datagram.size()) return std::nullopt;
  return datagram;
}

}  // namespace ensonify::formats::all
