#include "messages/envelope.h"

#include <catch2/catch.hpp>
#include <string>

#include "messages/value.h"

using namespace ensonify::msg;

TEST_CASE("an envelope comes back as it was sent") {
  const Envelope sent{kWireMajor, kFlagWallFacts, 1, 2, 3, 4, 5, 6, -7};
  CHECK(decode_envelope(encode_envelope(sent)) == sent);
}

TEST_CASE("an envelope of another size, magic or major is refused") {
  auto bytes = encode_envelope({});
  CHECK_THROWS_WITH(decode_envelope(std::span(bytes).first(63)), "envelope: has 63 bytes, not 64");
  CHECK_THROWS_WITH(decode_envelope({}), "envelope: has 0 bytes, not 64");
  bytes[4] = std::byte{9};
  CHECK_THROWS_WITH(decode_envelope(bytes), "envelope: wire version 9, this program speaks 1");
  bytes[0] = std::byte{0};
  CHECK_THROWS_WITH(decode_envelope(bytes), "envelope: magic is not ENS1");
}

TEST_CASE("type hashes are FNV-1a, 64 bit") {
  CHECK(type_hash("") == 0xcbf29ce484222325U);  // published test vectors [FNV]
  CHECK(type_hash("a") == 0xaf63dc4c8601ec8cU);
  CHECK(type_hash("foobar") == 0x85944171f73967e8U);
}
