#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

namespace ensonify::msg {

inline constexpr std::uint32_t kMagic = 0x31534E45;  // "ENS1" in little endian
inline constexpr std::uint16_t kWireMajor = 1;
inline constexpr std::uint16_t kFlagWallFacts = 1;  // the last frame holds wall-clock facts, outside every digest

/// Frame 1 of every data message: 64 bytes, little endian, fields in this order, zero padded.
struct Envelope {
  std::uint16_t version = kWireMajor;
  std::uint16_t flags = 0;
  std::uint32_t epoch = 0;
  std::uint32_t publisher = 0;  // rank of the process in the launch file
  std::uint32_t topic_id = 0;
  std::uint32_t frame_count = 0;  // of the whole message, topic and envelope included
  std::uint64_t type_hash = 0;
  std::uint64_t seq = 0;      // counts from 0 for each topic and epoch
  std::int64_t t_sim_ns = 0;  // event time at which it was published

  bool operator==(const Envelope&) const = default;
};

inline constexpr std::size_t kEnvelopeBytes = 64;
std::array<std::byte, kEnvelopeBytes> encode_envelope(const Envelope& envelope);
/// Throws DecodeError for a wrong size, magic or version.
Envelope decode_envelope(std::span<const std::byte> bytes);

/// FNV-1a (64 bit) of a message type's name such as "ping/1".
std::uint64_t type_hash(std::string_view type);

}  // namespace ensonify::msg
