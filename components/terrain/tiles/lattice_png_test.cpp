#include <catch2/catch.hpp>

#include "components/terrain/tiles/file_bytes.h"

using namespace ensonify::tiles;
using Catch::Matchers::Contains;

namespace {

GreyImage<std::uint16_t> counted(int side) {
  GreyImage<std::uint16_t> image{side, {}};
  for (int i = 0; i < side * side; ++i) image.value.push_back(static_cast<std::uint16_t>(i * 40503));
  return image;
}

}  // namespace

TEST_CASE("every 16-bit value comes back") {
  const auto image = counted(257);
  GreyImage<std::uint16_t> back;
  decode_png(encode_png(image), 257, back);
  CHECK(back.value == image.value);
}

TEST_CASE("every 8-bit value comes back") {
  GreyImage<std::uint8_t> image{16, {}}, back;
  for (int i = 0; i < 256; ++i) image.value.push_back(static_cast<std::uint8_t>(i));
  decode_png(encode_png(image), 16, back);
  CHECK(back.value == image.value);
}

TEST_CASE("bytes that are not a whole PNG of this size and depth are refused") {
  const auto png = encode_png(counted(33));
  GreyImage<std::uint16_t> image;
  GreyImage<std::uint8_t> classes;
  for (std::size_t end = 0; end < png.size(); end += 7)
    CHECK_THROWS_AS(decode_png(std::span(png).first(end), 33, image), TileError);
  CHECK_THROWS_WITH(decode_png(png, 32, image), Contains("another size"));
  CHECK_THROWS_WITH(decode_png(png, 33, classes), Contains("another size"));
  for (std::size_t byte = 8; byte < png.size(); byte += 11) {  // behind the signature: every chunk has a checksum
    auto flipped = png;
    flipped[byte] ^= 0x10;
    try {
      decode_png(flipped, 33, image);  // libpng lets some pass in chunks that it skips; values must not change
      CHECK(image.value == counted(33).value);
    } catch (const TileError&) {
      SUCCEED();
    }
  }
}
