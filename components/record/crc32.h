#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace ensonify::record {

/// CRC-32 as MCAP, zlib and Ethernet use it (reflected polynomial 0xEDB88320), computed piece by piece.
class Crc32 {
 public:
  void update(std::span<const std::byte> bytes);
  std::uint32_t value() const { return ~state_; }

 private:
  std::uint32_t state_ = 0xFFFFFFFFU;
};

inline std::uint32_t crc32(std::span<const std::byte> bytes) {
  Crc32 crc;
  crc.update(bytes);
  return crc.value();
}

}  // namespace ensonify::record
