#include "components/formats/xtf/reader.h"

#include <algorithm>

#include "components/formats/decode.h"

namespace ensonify::formats::xtf {

std::optional<FileHeader> read_file_header(Window& file, std::uint64_t& bytes) {
  constexpr std::size_t kLongest = 1U << 18U;  // two thousand channels
  const ByteView begin = file.at(0, kLongest);
  LayoutReader in(begin);
  FileHeader header;
  in(header);
  bytes = begin.size() - in.left().size();
  if (in.failed()) return std::nullopt;
  return header;
}

Reader::Reader(Window& file)
    : header_(read_file_header(file, header_bytes_)), walk_(file, header_ ? header_bytes_ : file.size()) {
  if (!header_) {
    walk_.faults().add(0,
                       "no header of an XTF file stands there: its first byte must be 123, its length 1024 at least");
    walk_.faults().add_skipped(file.size());
  }
}

void Reader::prepare(SonarPing& ping, const PacketHeader& header, std::size_t bytes) const {
  ping.channels.resize(std::min<std::size_t>(header.channels, bytes / fixed_bytes<Channel>() + 1));  // more fail
  for (std::size_t i = 0; i < ping.channels.size(); ++i) {
    if (i >= header_->channels.size()) break;
    ping.channels[i].default_count = header_->channels[i].samples;
    ping.channels[i].bytes_per_sample = header_->channels[i].bytes_per_sample;
  }
}

std::optional<Packet> Reader::next() {
  const auto frame = walk_.next();
  if (!frame) return std::nullopt;

  Packet packet;
  packet.offset = frame->offset;
  LayoutReader in(frame->bytes.subspan(sizeof FrameFormat::kMagic));
  std::uint32_t length = 0;
  in(packet.header, length);

  const ByteView body = in.left();
  const auto of_type = [&]<class One>(std::type_identity<One>) { return One::kType == packet.header.type; };
  const auto prepared = [&]<class One>(One& one) {
    if constexpr (std::is_same_v<One, SonarPing>) prepare(one, packet.header, body.size());
    else if constexpr (requires { one.beams; }) {
      using Beam = typename decltype(one.beams)::value_type;
      one.beams.resize(std::min<std::size_t>(packet.header.channels, body.size() / fixed_bytes<Beam>() + 1));
    }
  };
  if (decode(body, packet.body, packet.rest, of_type, prepared) == Decoded::malformed) {
    walk_.faults().add(frame->offset, "the body of packet type " + std::to_string(packet.header.type) + " is " +
                                          std::to_string(body.size()) +
                                          " bytes, shorter than its own counts say; kept as bytes");
  }
  packet.padded = frame->bytes.size() % FrameFormat::kPadding == 0;
  const bool zeros = std::all_of(packet.rest.begin(), packet.rest.end(), [](std::byte b) { return b == std::byte{0}; });
  if (packet.padded && zeros && packet.rest.size() < FrameFormat::kPadding) packet.rest.clear();
  return packet;
}

}  // namespace ensonify::formats::xtf
