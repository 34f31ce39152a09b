#include "tools/console/frame.h"

#include <string>

namespace ensonify::console {

namespace {

constexpr std::size_t kAlign = 8;

std::size_t padding(std::size_t size) { return (kAlign - size % kAlign) % kAlign; }

void put_padded(std::string& to, std::string_view bytes) {
  to.append(bytes);
  to.append(padding(bytes.size()), '\0');
}

void put_length(std::string& to, std::size_t length) {
  for (int shift = 0; shift < 32; shift += 8) to.push_back(static_cast<char>((length >> shift) & 0xFFU));
}

}  // namespace

std::vector<msg::Buffer> frame_of(const msg::Packet& packet) {
  msg::Envelope envelope = packet.envelope;
  envelope.flags = 0;  // wall facts do not travel
  envelope.frame_count = static_cast<std::uint32_t>(msg::kFirstArrayFrame + packet.body.arrays.size());
  const auto coded = msg::encode_envelope(envelope);
  std::string head(reinterpret_cast<const char*>(coded.data()), coded.size());
  put_length(head, packet.topic.size());
  put_length(head, packet.body.map.size);
  put_padded(head, packet.topic);
  put_padded(head, packet.body.map.text());
  std::vector<msg::Buffer> parts{msg::Buffer::own(std::move(head))};
  for (const msg::Buffer& array : packet.body.arrays) {
    if (array.size == 0) continue;
    parts.push_back(array);
    if (padding(array.size) > 0) parts.push_back(msg::Buffer::own(std::string(padding(array.size), '\0')));
  }
  return parts;
}

std::size_t size_of(const std::vector<msg::Buffer>& parts) {
  std::size_t size = 0;
  for (const msg::Buffer& part : parts) size += part.size;
  return size;
}

}  // namespace ensonify::console
