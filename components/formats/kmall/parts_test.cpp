#include "components/formats/kmall/parts.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "components/formats/kmall/reader.h"
#include "components/formats/kmall/writer.h"
#include "components/formats/testing/sample.h"

using namespace ensonify::formats;
using namespace ensonify::formats::kmall;

namespace {

/// A water column of about 200 kB: four parts.
Bytes column(std::uint32_t time_s = 1'000, std::uint8_t fan = 0) {
  WaterColumn written;
  written.ping.ping = static_cast<std::uint16_t>(time_s);
  written.ping.fan = fan;
  for (int i = 0; i < 256; ++i) {
    WaterColumn::Beam beam;
    for (int k = 0; k < 764; ++k)
      beam.amplitude_half_db.push_back(static_cast<std::int8_t>((i * k + fan + static_cast<int>(time_s)) % 200 - 100));
    written.beams.push_back(beam);
  }
  Bytes out;
  Writer(2040).append_body(out, std::int64_t{time_s} * 1'000'000'000, written);
  return out;
}

std::optional<Bytes> take_all(PartJoiner& joiner, const std::vector<Bytes>& parts) {
  std::optional<Bytes> whole;
  for (const Bytes& part : parts) {
    if (auto one = joiner.take(part)) {
      CHECK_FALSE(whole);
      whole = std::move(one);
    }
  }
  return whole;
}

}  // namespace

TEST_CASE("a datagram is cut into whole frames of at most 64,000 bytes that say which they are") {
  const Bytes whole = column();
  const std::vector<Bytes> parts = parts_of(whole);
  REQUIRE(parts.size() == 4);
  std::size_t body = 0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    CHECK(parts[i].size() <= 64'000);
    CHECK(ByteSource(parts[i]).number<std::uint32_t>() == parts[i].size());
    CHECK(ByteSource(ByteView(parts[i]).last(4)).number<std::uint32_t>() == parts[i].size());
    CHECK(std::equal(parts[i].begin() + 4, parts[i].begin() + 20, whole.begin() + 4));
    ByteSource partition(ByteView(parts[i]).subspan(20));
    CHECK(partition.number<std::uint16_t>() == 4);
    CHECK(partition.number<std::uint16_t>() == i + 1);
    body += parts[i].size() - 28;
  }
  CHECK(body == whole.size() - 28);
}

TEST_CASE("what fits, and what has no parts, goes as it is") {
  const sample::File file = sample::kmall_file();
  ByteView left = file.bytes;
  PartJoiner joiner;
  Bytes again;
  while (!left.empty()) {
    const ByteView datagram = left.first(datagram_bytes(left));
    left = left.subspan(datagram.size());
    const std::vector<Bytes> parts = parts_of(datagram);
    REQUIRE(parts.size() == 1);
    const auto whole = joiner.take(parts[0]);
    REQUIRE(whole);
    again.insert(again.end(), whole->begin(), whole->end());
  }
  CHECK((again == file.bytes));

  Bytes text;
  append(text, {.type = "#IIP", .body = Raw{Bytes(70'000)}});
  CHECK((parts_of(text) == std::vector<Bytes>{text}));
}

TEST_CASE("a part is as long as it may be, and one byte more makes two") {
  const auto of_length = [](std::size_t bytes) {
    Bytes datagram;
    append(datagram, {.type = "#MWC", .body = Raw{Bytes(bytes - 24)}});
    REQUIRE(datagram.size() == bytes);
    return parts_of(datagram);
  };
  CHECK(of_length(64'000).size() == 1);
  CHECK(of_length(64'001).size() == 2);
  CHECK(of_length(64'001)[1].size() == 29);
}

TEST_CASE("parts join in any order, between other datagrams, to the datagram of the file") {
  const Bytes whole = column();
  std::vector<Bytes> parts = parts_of(whole);
  std::vector<std::size_t> order{0, 1, 2, 3};
  do {
    PartJoiner joiner;
    std::optional<Bytes> joined;
    for (const std::size_t i : order) {
      if (auto one = joiner.take(parts[i])) joined = std::move(one);
      CHECK(joiner.take(sample::kmall_file().bytes) == std::nullopt);  // many in one: no frame of a network
    }
    REQUIRE((joined == whole));
    CHECK(joiner.counts().whole == 1);
    CHECK(joiner.counts().refused == 4);
  } while (std::next_permutation(order.begin(), order.end()));
}

TEST_CASE("parts of two pings join, however they are mixed") {
  const Bytes first = column(1), second = column(2);
  const auto a = parts_of(first), b = parts_of(second);
  PartJoiner joiner;
  std::vector<Bytes> given;
  for (const Bytes& part : {a[0], b[0], b[1], a[3], a[2], b[3], b[2], a[1]}) {
    if (auto one = joiner.take(part)) given.push_back(std::move(*one));
  }
  CHECK((given == std::vector<Bytes>{second, first}));
}

TEST_CASE("a doubled part is dropped and counted, also behind its datagram") {
  const Bytes whole = column();
  const auto parts = parts_of(whole);
  PartJoiner joiner;
  const auto joined =
      take_all(joiner, {parts[0], parts[0], parts[1], parts[2], parts[0], parts[3], parts[3], parts[1]});
  CHECK((joined == whole));
  joiner.finish();
  CHECK(joiner.counts().doubled == 4);
  CHECK(joiner.counts().whole == 1);
  CHECK(joiner.counts().incomplete == 0);
}

TEST_CASE("a missing part costs its datagram, and no other") {
  PartJoiner joiner;
  std::vector<Bytes> given;
  for (std::uint32_t ping = 1; ping <= 40; ++ping) {
    auto parts = parts_of(column(ping));
    if (ping % 4 == 0) parts.erase(parts.begin() + ping / 4 % 4);
    for (const Bytes& part : parts) {
      if (auto one = joiner.take(part)) given.push_back(std::move(*one));
    }
  }
  CHECK(given.size() == 30);
  CHECK(joiner.counts().incomplete == 2);  // of ten, eight are waited for
  joiner.finish();
  CHECK(joiner.counts().incomplete == 10);
  CHECK(joiner.counts().whole == 30);
}

TEST_CASE("two heads of one time are not mixed, also where the first lacks a part") {
  const Bytes port = column(5, 0), starboard = column(5, 1);
  PartJoiner whole, lacking;
  CHECK((take_all(whole, parts_of(port)) == port));  // in brackets: a failure does not print 200 kB
  CHECK((take_all(whole, parts_of(starboard)) == starboard));
  CHECK(whole.counts().incomplete == 0);
  auto parts = parts_of(port);
  parts.pop_back();
  CHECK_FALSE(take_all(lacking, parts));
  CHECK((take_all(lacking, parts_of(starboard)) == starboard));
  CHECK(lacking.counts().incomplete == 1);
}

TEST_CASE("what cannot be a part is refused and counted") {
  const auto parts = parts_of(column());
  PartJoiner joiner;
  std::int64_t refused = 0;
  const auto is_refused = [&](Bytes part) {
    CHECK_FALSE(joiner.take(part));
    return joiner.counts().refused == ++refused;
  };
  const auto numbered = [&](std::uint16_t of, std::uint16_t part) {
    Bytes bytes = parts[1];
    replace_number(bytes, 20, of);
    replace_number(bytes, 22, part);
    return bytes;
  };
  CHECK(is_refused({}));
  CHECK(is_refused(Bytes(24)));
  CHECK(is_refused(Bytes(parts[0].begin(), parts[0].end() - 1)));
  CHECK(is_refused(numbered(4, 0)));
  CHECK(is_refused(numbered(4, 5)));
  CHECK(is_refused(numbered(0, 0)));
  CHECK(is_refused(numbered(65'535, 1)));
  CHECK(joiner.counts().incomplete == 0);
}
