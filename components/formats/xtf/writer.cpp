#include "components/formats/xtf/writer.h"

#include "components/formats/decode.h"
#include "components/formats/xtf/frame.h"

namespace ensonify::formats::xtf {

void append(Bytes& out, const FileHeader& header) {
  ENSONIFY_ASSERT(header.channels.size() == FileHeader::room(header.channels_used()),
                  std::to_string(header.channels.size()) + " channels in a file header with room for " +
                      std::to_string(FileHeader::room(header.channels_used())));
  LayoutWriter wire(out);
  wire(header);
}

void append(Bytes& out, const Packet& packet) {
  const std::size_t begin = out.size();
  LayoutWriter wire(out);
  wire.constant(FrameFormat::kMagic);
  wire(packet.header);
  wire.constant(std::uint32_t{0});  // the length, known below
  encode(packet.body, out);
  out.insert(out.end(), packet.rest.begin(), packet.rest.end());
  if (const std::size_t over = (out.size() - begin) % FrameFormat::kPadding; packet.padded && over > 0) {
    out.resize(out.size() + FrameFormat::kPadding - over);
  }
  replace_number(out, begin + FrameFormat::kLengthAt, static_cast<std::uint32_t>(out.size() - begin));
}

Packet packet_of(Body body) {
  Packet packet;
  std::visit(
      [&]<class One>(const One& one) {
        if constexpr (!std::is_same_v<One, Raw>) packet.header.type = One::kType;
        if constexpr (requires { one.channels; })
          packet.header.channels = static_cast<std::uint16_t>(one.channels.size());
        if constexpr (requires { one.beams; }) packet.header.channels = static_cast<std::uint16_t>(one.beams.size());
      },
      body);
  packet.body = std::move(body);
  return packet;
}

}  // namespace ensonify::formats::xtf
