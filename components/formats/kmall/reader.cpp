#include "components/formats/kmall/reader.h"

#include "components/formats/decode.h"

namespace ensonify::formats::kmall {

std::optional<Datagram> Reader::next() {
  const auto frame = walk_.next();
  if (!frame) return std::nullopt;

  Datagram datagram;
  datagram.offset = frame->offset;
  const ByteView type = frame->bytes.subspan(FrameFormat::kLengthBytes, FrameFormat::kTypeBytes);
  datagram.type.assign(reinterpret_cast<const char*>(type.data()), type.size());
  const std::size_t before = FrameFormat::kLengthBytes + FrameFormat::kTypeBytes;
  LayoutReader in(frame->bytes.subspan(before, frame->bytes.size() - before - FrameFormat::kLengthBytes));
  in(datagram.header);

  const ByteView body = in.left();
  const auto of_type = [&]<class One>(std::type_identity<One>) {
    return One::kType == datagram.type && One::kVersion == datagram.header.version;
  };
  if (decode(body, datagram.body, datagram.rest, of_type) == Decoded::malformed) {
    walk_.faults().add(frame->offset, "the body of " + datagram.type + " is " + std::to_string(body.size()) +
                                          " bytes and not what its own sizes and counts say; kept as bytes");
  }
  return datagram;
}

}  // namespace ensonify::formats::kmall
