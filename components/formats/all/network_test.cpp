#include "components/formats/all/network.h"

#include <catch2/catch.hpp>

#include "components/formats/testing/sample.h"

using namespace ensonify::formats;
using namespace ensonify::formats::all;

namespace {

std::vector<ByteView> datagrams_of(ByteView file) {
  std::vector<ByteView> datagrams;
  for (; !file.empty(); file = file.subspan(datagrams.back().size()))
    datagrams.push_back(file.first(datagram_bytes(file)));
  return datagrams;
}

}  // namespace

TEST_CASE("a .all datagram comes back from the network as the file has it") {
  const sample::File file = sample::all_file();
  const std::vector<ByteView> datagrams = datagrams_of(file.bytes);
  REQUIRE(datagrams.size() == file.offsets.size());
  Bytes again;
  for (const ByteView datagram : datagrams) {
    const ByteView sent = to_network(datagram);
    CHECK(sent.size() == datagram.size() - 4);
    CHECK(sent.front() == std::byte{2});
    const auto received = from_network(sent);
    REQUIRE(received);
    again.insert(again.end(), received->begin(), received->end());
  }
  CHECK(again == file.bytes);
}

TEST_CASE("what is no whole .all datagram is not taken from the network") {
  const sample::File file = sample::all_file();
  const ByteView sent = to_network(datagrams_of(file.bytes)[1]);
  for (std::size_t at = 0; at < sent.size(); ++at) {
    CAPTURE(at);
    Bytes damaged(sent.begin(), sent.end());
    damaged[at] ^= std::byte{0x20};
    CHECK_FALSE(from_network(damaged));
    CHECK_FALSE(from_network(sent.first(at)));
  }
  Bytes longer(sent.begin(), sent.end());
  longer.push_back(std::byte{0});
  CHECK_FALSE(from_network(longer));
  CHECK_FALSE(from_network(file.bytes));  // with the length of a file before it
}
