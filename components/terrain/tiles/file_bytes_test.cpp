
#include "components/terrain/tiles/file_bytes.h"

#include <array>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <string>

using namespace ensonify::tiles;

// The two messages of the standard's examples [FIPS180-4].
constexpr const char* kAbc = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
constexpr const char* kTwoBlocks = "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1";

TEST_CASE("checksums are those of the standard's examples, whole or in pieces") {
  Sha256 whole, pieces;
  const std::string message = "abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq";
  whole.add(std::as_bytes(std::span(message)));
  CHECK(whole.digest() == kTwoBlocks);
  for (const char letter : message) pieces.add(std::as_bytes(std::span(&letter, 1)));
  CHECK(pieces.digest() == kTwoBlocks);
}

TEST_CASE("a file has the checksum of its bytes, a missing one is named") {
  const auto folder = std::filesystem::temp_directory_path() / "ensonify_sha256_test";
  std::filesystem::create_directories(folder);
  const std::string path = folder / "abc";
  write_file(path, std::string_view("abc"));
  CHECK(sha256_of_file(path) == kAbc);
  CHECK_THROWS_AS(sha256_of_file(folder / "missing"), TileError);
}

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
