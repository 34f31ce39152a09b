#include "tools/console/frame.h"

#include <catch2/catch.hpp>
#include <cstring>

#include "messages/view.h"

using namespace ensonify;
using namespace ensonify::console;

TEST_CASE("a frame is envelope, lengths, topic, map and arrays, each from a multiple of 8 bytes on") {
  msg::View view;
  view.ping = 12;
  view.level = msg::Array<std::uint8_t>({1, 3});
  view.level[2] = 77;
  view.beam_angle_rad = msg::Array<float>::of({0.25F});
  msg::Packet packet{"bow/view", {}, msg::encode(view), {}};
  packet.envelope.seq = 5;
  packet.envelope.type_hash = msg::type_hash(msg::View::kType);

  std::vector<std::byte> bytes;
  for (const msg::Buffer& part : frame_of(packet)) bytes.insert(bytes.end(), part.data, part.data + part.size);
  REQUIRE(bytes.size() == size_of(frame_of(packet)));
  REQUIRE(bytes.size() % 8 == 0);

  const msg::Envelope envelope = msg::decode_envelope({bytes.data(), 64});
  CHECK(envelope.seq == 5);
  CHECK(envelope.frame_count == 3 + 5);  // of five arrays three are empty
  std::uint32_t lengths[2];
  std::memcpy(lengths, bytes.data() + 64, sizeof lengths);
  CHECK(lengths[0] == 8);
  CHECK(lengths[1] == packet.body.map.size);
  CHECK(std::memcmp(bytes.data() + 72, "bow/view", 8) == 0);
  CHECK(std::memcmp(bytes.data() + 80, packet.body.map.data, packet.body.map.size) == 0);
  const std::size_t arrays = 80 + (packet.body.map.size + 7) / 8 * 8;
  CHECK(static_cast<int>(bytes[arrays + 2]) == 77);
  float angle = 0.0F;
  std::memcpy(&angle, bytes.data() + arrays + 8, sizeof angle);
  CHECK(angle == 0.25F);
  CHECK(bytes.size() == arrays + 16);
}
