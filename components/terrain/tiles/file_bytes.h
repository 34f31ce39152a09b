#pragma once

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

}  // namespace ensonify::tiles
