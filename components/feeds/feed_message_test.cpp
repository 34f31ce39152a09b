#include "components/feeds/feed_message.h"

#include <catch2/catch.hpp>

#include "messages/codec.h"

using namespace ensonify;

namespace {

std::vector<ByteSource> two_sources() {
  std::vector<ByteSource> sources(2);
  sources[0].name = "gnss";
  sources[1].name = "mru";
  return sources;
}

}  // namespace

TEST_CASE("what an event took comes back from its message, byte for byte") {
  const std::vector<FedPiece> taken{{1, SimTime{1'000'000}, std::string("\0\xff:0900\r\n", 9), true, false},
                                    {0, SimTime{2'000'000}, "", false, true},
                                    {0, SimTime{3'000'000}, "$HEHDT", false, true}};
  std::vector<FedPiece> again;
  append_pieces(msg::decode<msg::FeedData>(msg::encode(feed_data(SimTime{5'000'000}, two_sources(), taken)), 1U << 20U),
                two_sources(), again);
  REQUIRE(again.size() == taken.size());
  for (std::size_t i = 0; i < taken.size(); ++i) {
    CHECK(again[i].source == taken[i].source);
    CHECK(again[i].arrival == taken[i].arrival);
    CHECK(again[i].bytes == taken[i].bytes);
    CHECK(again[i].begins == taken[i].begins);
    CHECK(again[i].whole == taken[i].whole);
  }
}

TEST_CASE("a message that promises more bytes than it has gives those that it has") {
  msg::FeedData data = feed_data(SimTime{0}, two_sources(), {{0, SimTime{0}, "$HEHDT", false, true}});
  data.pieces[0].byte_count = 1'000'000'000'000;
  data.pieces.push_back({"gnss", 0, -5, false, true});
  data.pieces.push_back({"somebody", 0, 3, false, true});
  std::vector<FedPiece> pieces;
  append_pieces(data, two_sources(), pieces);
  REQUIRE(pieces.size() == 2);
  CHECK(pieces[0].bytes == "$HEHDT");
  CHECK(pieces[1].bytes.empty());
}
