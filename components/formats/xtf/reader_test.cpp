#include "components/formats/xtf/reader.h"

#include <catch2/catch.hpp>
#include <set>

#include "components/formats/testing/contents.h"
#include "components/formats/testing/sample.h"
#include "components/formats/xtf/writer.h"

using namespace ensonify::formats;
using namespace ensonify::formats::xtf;

namespace {

struct Contents : sample::Contents<Packet> {
  std::optional<FileHeader> header;
};

Contents read(ByteView bytes) {
  Window file(bytes);
  Contents contents{sample::contents_of<Packet, Reader>(file), Reader(file).header()};
  return contents;
}

Bytes written(const Contents& contents) {
  Bytes bytes;
  append(bytes, contents.header.value());
  for (const Packet& packet : contents.datagrams) append(bytes, packet);
  return bytes;
}

}  // namespace

TEST_CASE("every XTF packet that we write is read back and written again as it was") {
  const sample::File file = sample::xtf_file();
  const Contents contents = read(file.bytes);
  CHECK(contents.faults.count() == 0);
  REQUIRE(contents.datagrams.size() == file.offsets.size());
  std::set<std::size_t> alternatives;
  for (const Packet& packet : contents.datagrams) {
    alternatives.insert(packet.body.index());
    CHECK(packet.rest.empty());
    CHECK(packet.unix_ns().value() >= sample::kBegin_ns);
  }
  CHECK(alternatives.size() == std::variant_size_v<Body> - 1);  // all but Raw
  CHECK(written(contents) == file.bytes);
}

TEST_CASE("XTF's header is 1024 bytes, a ping's 256, a channel's and a beam's 64") {
  const std::size_t frame = FrameFormat::kHeadBytes;
  CHECK(fixed_bytes<ChannelInfo>() == 128);
  CHECK(fixed_bytes<PingHeader>() + frame == 256);
  CHECK(fixed_bytes<Channel>() == 64);
  CHECK(fixed_bytes<Attitude>() + frame == 64);
  CHECK(fixed_bytes<RawNavigation>() + frame == 64);
  CHECK(fixed_bytes<Notes>() + frame == 256);
  CHECK(fixed_bytes<MultibeamPing::Beam>() == 64);
  CHECK(fixed_bytes<MultiTransmitPing::Beam>() == 48);
  for (const auto& [channels, bytes] : {std::pair{0U, 1024U}, {6U, 1024U}, {7U, 2048U}, {14U, 2048U}, {15U, 3072U}}) {
    FileHeader header{.sonar_channels = static_cast<std::uint16_t>(channels)};
    header.channels.resize(FileHeader::room(channels));
    Bytes written;
    append(written, header);
    CHECK(written.size() == bytes);
  }
}

TEST_CASE("every XTF packet that we write is a multiple of 64 bytes") {
  sample::File file = sample::xtf_file();
  file.offsets.push_back(file.bytes.size());
  for (const std::size_t offset : file.offsets) CHECK(offset % 64 == 0);
}

TEST_CASE("a damaged magic number or length costs one XTF packet and is noted") {
  const sample::File file = sample::xtf_file();
  for (std::size_t i = 0; i < file.offsets.size(); ++i) {
    for (const std::size_t at : {0U, 1U, 10U, 11U, 12U, 13U}) {
      for (int bit = 0; bit < 8; ++bit) {
        CAPTURE(i, at, bit);
        Bytes damaged = file.bytes;
        damaged[file.offsets[i] + at] ^= std::byte(1U << bit);
        const Contents contents = read(damaged);
        REQUIRE(contents.faults.count() > 0);
        std::set<std::uint64_t> read_at;
        for (const Packet& packet : contents.datagrams) read_at.insert(packet.offset);
        for (std::size_t other = 0; other < file.offsets.size(); ++other) {
          if (other != i) REQUIRE(read_at.count(file.offsets[other]) == 1);
        }
      }
    }
  }
}

TEST_CASE("a flipped bit in an XTF body changes that packet only") {
  const sample::File file = sample::xtf_file();
  for (std::size_t at = 1024; at < file.bytes.size(); at += 3) {
    CAPTURE(at);
    Bytes damaged = file.bytes;
    damaged[at] ^= std::byte{0x10};
    const Contents contents = read(damaged);
    if (contents.faults.count() == 0) REQUIRE(written(contents) == damaged);
    REQUIRE(contents.datagrams.size() + 1 >= file.offsets.size());
  }
}

TEST_CASE("an XTF file cut anywhere gives what is whole and says where it ends") {
  const sample::File file = sample::xtf_file();
  for (std::size_t bytes = 0; bytes < file.bytes.size(); bytes += 16) {
    CAPTURE(bytes);
    const Contents contents = read(ByteView(file.bytes).first(bytes));
    const auto begun = std::upper_bound(file.offsets.begin(), file.offsets.end(), bytes) - file.offsets.begin();
    const bool at_an_end = std::find(file.offsets.begin(), file.offsets.end(), bytes) != file.offsets.end();
    REQUIRE(contents.datagrams.size() == static_cast<std::size_t>(std::max<std::ptrdiff_t>(begun - 1, 0)));
    REQUIRE(contents.faults.count() == (at_an_end ? 0 : 1));
  }
}

TEST_CASE("more channels or samples than a packet has bytes for keep its bytes and are noted") {
  const sample::File file = sample::xtf_file();
  const std::size_t ping = file.offsets[3];
  Bytes channels = file.bytes;
  replace_number(channels, ping + 4, std::uint16_t{65'535});
  Bytes samples = file.bytes;
  replace_number(samples, ping + 256 + 42, std::uint32_t{4'000'000'000});
  for (const Bytes& damaged : {channels, samples}) {
    const Contents contents = read(damaged);
    CHECK(contents.faults.count() == 1);
    CHECK(contents.faults.kept()[0].offset == ping);
    CHECK(std::holds_alternative<Raw>(contents.datagrams[3].body));
    CHECK(written(contents) == damaged);
  }
}

TEST_CASE("packets without padding are written again without") {
  Bytes bytes;
  append(bytes, FileHeader{});
  Packet packet = packet_of(RawSerial{.time = Time::of(sample::kBegin_ns), .text = "abc"});
  packet.padded = false;
  append(bytes, packet);
  append(bytes, packet);
  const Contents contents = read(bytes);
  CHECK(contents.datagrams.size() == 2);
  CHECK(contents.faults.count() == 0);
  CHECK(written(contents) == bytes);
}
