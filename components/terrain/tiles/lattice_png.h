#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace ensonify::tiles {

/// Error that makes a tile set unreadable or unwritable; the text says where and why.
struct TileError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A square grey image in memory, rows from the north as images have them.
template <class Value>
struct GreyImage {
  int side = 0;
  std::vector<Value> value;
};

/// PNG, lossless. The bytes depend on the values and the version of libpng only. Throws TileError.
std::vector<std::uint8_t> encode_png(const GreyImage<std::uint16_t>& image);
std::vector<std::uint8_t> encode_png(const GreyImage<std::uint8_t>& image);

/// The reverse. Throws TileError for anything but a whole grey PNG of that depth and `side` by `side` values.
void decode_png(std::span<const std::uint8_t> png, int side, GreyImage<std::uint16_t>& image);
void decode_png(std::span<const std::uint8_t> png, int side, GreyImage<std::uint8_t>& image);

}  // namespace ensonify::tiles
