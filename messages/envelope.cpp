#include "messages/envelope.h"

#include <bit>
#include <cstring>
#include <string>

#include "messages/value.h"

namespace ensonify::msg {

namespace {

// The layout is little endian; so are the machines that we build for.
static_assert(std::endian::native == std::endian::little);

struct Layout {
  std::uint32_t magic;
  std::uint16_t version;
  std::uint16_t flags;
  std::uint32_t epoch;
  std::uint32_t publisher;
  std::uint32_t topic_id;
  std::uint32_t frame_count;
  std::uint64_t type_hash;
  std::uint64_t seq;
  std::int64_t t_sim_ns;
  std::uint8_t reserved[16];
};
static_assert(sizeof(Layout) == kEnvelopeBytes);

}  // namespace

std::array<std::byte, kEnvelopeBytes> encode_envelope(const Envelope& e) {
  const Layout layout{kMagic,        e.version,   e.flags, e.epoch,    e.publisher, e.topic_id,
                      e.frame_count, e.type_hash, e.seq,   e.t_sim_ns, {}};
  std::array<std::byte, kEnvelopeBytes> bytes;
  std::memcpy(bytes.data(), &layout, sizeof layout);
  return bytes;
}

Envelope decode_envelope(std::span<const std::byte> bytes) {
  if (bytes.size() != kEnvelopeBytes) {
    throw DecodeError("envelope: has " + std::to_string(bytes.size()) + " bytes, not 64");
  }
  Layout l;
  std::memcpy(&l, bytes.data(), sizeof l);
  if (l.magic != kMagic) throw DecodeError("envelope: magic is not ENS1");
  if (l.version != kWireMajor) {
    throw DecodeError("envelope: wire version " + std::to_string(l.version) + ", this program speaks " +
                      std::to_string(kWireMajor));
  }
  return {l.version, l.flags, l.epoch, l.publisher, l.topic_id, l.frame_count, l.type_hash, l.seq, l.t_sim_ns};
}

std::uint64_t type_hash(std::string_view type) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const char c : type) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
  return hash;
}

}  // namespace ensonify::msg
