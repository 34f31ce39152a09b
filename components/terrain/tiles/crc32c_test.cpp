#include <array>
#include <catch2/catch.hpp>
#include <string>

#include "components/terrain/tiles/file_bytes.h"

using ensonify::tiles::crc32c;

TEST_CASE("CRC-32C is that of the standard's examples, whole or in pieces") {
  std::array<std::byte, 32> bytes{};
  CHECK(crc32c(bytes) == 0x8a9136aa);  // [RFC3720, appendix B.4]
  bytes.fill(std::byte{0xff});
  CHECK(crc32c(bytes) == 0x62a8ab43);
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::byte>(i);
  CHECK(crc32c(bytes) == 0x46dd794e);
  const std::string digits = "123456789";
  CHECK(crc32c(std::as_bytes(std::span(digits))) == 0xe3069283);
  for (std::size_t first = 0; first <= bytes.size(); ++first)
    CHECK(crc32c(std::span(bytes).subspan(first), crc32c(std::span(bytes).first(first))) == 0x46dd794e);
}
