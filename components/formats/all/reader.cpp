#include "components/formats/all/reader.h"

#include "components/formats/decode.h"

namespace ensonify::formats::all {

std::optional<Datagram> Reader::next() {
  const auto frame = walk_.next();
  if (!frame) return std::nullopt;

  Datagram datagram;
  datagram.offset = frame->offset;
  const std::size_t outside = FrameFormat::kLengthBytes + 1 + FrameFormat::kTrailerBytes;
  LayoutReader in(frame->bytes.subspan(FrameFormat::kLengthBytes + 1, frame->bytes.size() - outside));
  std::uint8_t type = 0;
  in(type, datagram.header);
  datagram.type = static_cast<char>(type);

  const ByteView body = in.left();
  const auto of_type = [&]<class One>(std::type_identity<One>) {
    return One::kTypes.find(datagram.type) != std::string_view::npos;
  };
  if (decode(body, datagram.body, datagram.rest, of_type) == Decoded::malformed) {
    walk_.faults().add(frame->offset, std::string("the body of ") + datagram.type + " is " +
                                          std::to_string(body.size()) +
                                          " bytes, shorter than its own counts say; kept as bytes");
  }
  // The spare zero that keeps the length even.
  datagram.padded = frame->bytes.size() % 2 == 0;
  if (datagram.padded && datagram.rest.size() == 1 && datagram.rest[0] == std::byte{0}) datagram.rest.clear();
  return datagram;
}

}  // namespace ensonify::formats::all
