#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace ensonify::tiles {

/// The whole file. Throws TileError naming it.
std::vector<std::uint8_t> read_file(const std::string& path);

/// Writes beside the path first and renames, so that no half file is ever seen there. Throws TileError naming it.
void write_file(const std::string& path, std::span<const std::uint8_t> bytes);
void write_file(const std::string& path, std::string_view text);

/// CRC-32C (Castagnoli's polynomial, reflected, as iSCSI has it) [RFC3720, appendix B.4]: finds what a disk or a power
/// cut has spoilt, in a fifth of the time that SHA-256 takes; not what somebody has forged. `before`: that of the bytes
/// before these.
std::uint32_t crc32c(std::span<const std::byte> bytes, std::uint32_t before = 0);

}  // namespace ensonify::tiles
