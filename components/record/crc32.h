#pragma once

#include <zlib.h>

#include <cstddef>
#include <cstdint>
#include <span>

namespace ensonify::record {

/// CRC-32 of MCAP, zlib and Ethernet (reflected polynomial 0xEDB88320) of `bytes`, which follow what gave `before`.
inline std::uint32_t crc32(std::span<const std::byte> bytes, std::uint32_t before = 0) {
  return static_cast<std::uint32_t>(crc32_z(before, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

}  // namespace ensonify::record
