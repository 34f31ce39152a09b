#include "components/formats/kmall/reader.h"

#include <catch2/catch.hpp>
#include <set>

#include "components/formats/kmall/writer.h"
#include "components/formats/testing/contents.h"
#include "components/formats/testing/sample.h"

using namespace ensonify::formats;
using namespace ensonify::formats::kmall;

namespace {

using Contents = sample::Contents<Datagram>;

Contents read(ByteView bytes) {
  Window file(bytes);
  return sample::contents_of<Datagram, Reader>(file);
}

Bytes written(const std::vector<Datagram>& datagrams) {
  Bytes bytes;
  for (const Datagram& datagram : datagrams) append(bytes, datagram);
  return bytes;
}

}  // namespace

TEST_CASE("every .kmall datagram that we write is read back and written again as it was") {
  const sample::File file = sample::kmall_file();
  const Contents contents = read(file.bytes);
  CHECK(contents.faults.count() == 0);
  REQUIRE(contents.datagrams.size() == file.offsets.size());
  std::set<std::size_t> alternatives;
  for (const Datagram& datagram : contents.datagrams) {
    alternatives.insert(datagram.body.index());
    CHECK(datagram.rest.empty());
  }
  CHECK(alternatives.size() == std::variant_size_v<Body> - 1);  // all but Raw
  CHECK(written(contents.datagrams) == file.bytes);
}

TEST_CASE("layouts are as long as the revision states") {
  CHECK(fixed_bytes<Motion::Sample>() == 132);
  CHECK(fixed_bytes<Sounding>() == 120);
  CHECK(fixed_bytes<Soundings::Sector>() == 48);
  CHECK(fixed_bytes<PingInfo>() + fixed_bytes<PingPose>() + 3 * sizeof(std::uint16_t) == Soundings::kInfoBytes);
  CHECK(fixed_bytes<WaterColumn::Sector>() == 16);
  CHECK(fixed_bytes<WaterColumn::Beam>() == 16);
  CHECK(fixed_bytes<SoundSpeedProfile::Node>() == 20);
  CHECK(fixed_bytes<SurfaceSoundSpeed::Sample>() == 24);
}

TEST_CASE("a damaged length or mark costs one datagram and is noted") {
  const sample::File file = sample::kmall_file();
  for (std::size_t i = 0; i + 1 < file.offsets.size(); ++i) {
    const std::size_t begin = file.offsets[i], end = file.offsets[i + 1];
    for (const std::size_t at :
         {begin, begin + 1, begin + 2, begin + 3, begin + 4, end - 4, end - 3, end - 2, end - 1}) {
      for (const int bit : {0, 3, 7}) {
        CAPTURE(at, bit);
        Bytes damaged = file.bytes;
        damaged[at] ^= std::byte(1U << bit);
        const Contents contents = read(damaged);
        REQUIRE(contents.faults.count() == 1);
        REQUIRE(contents.faults.kept()[0].offset == begin);
        REQUIRE(contents.faults.skipped_bytes() == end - begin);
        REQUIRE(contents.datagrams.size() == file.offsets.size() - 1);
      }
    }
  }
}

TEST_CASE("a flipped bit anywhere costs at most its own .kmall datagram") {
  const sample::File file = sample::kmall_file();
  for (std::size_t at = 0; at < file.bytes.size(); ++at) {
    CAPTURE(at);
    Bytes damaged = file.bytes;
    damaged[at] ^= std::byte{0x10};
    const Contents contents = read(damaged);
    const std::size_t lost = file.offsets.size() - contents.datagrams.size();
    REQUIRE(lost <= 1);
    REQUIRE(contents.faults.count() >= lost);
    if (lost == 0) REQUIRE(written(contents.datagrams) == damaged);
  }
}

TEST_CASE("a .kmall file cut anywhere gives what is whole and says where it ends") {
  const sample::File file = sample::kmall_file();
  for (std::size_t bytes = 0; bytes < file.bytes.size(); bytes += 5) {
    CAPTURE(bytes);
    const Contents contents = read(ByteView(file.bytes).first(bytes));
    const auto whole = std::upper_bound(file.offsets.begin(), file.offsets.end(), bytes) - file.offsets.begin() - 1;
    const bool at_an_end = file.offsets[static_cast<std::size_t>(whole)] == bytes;
    REQUIRE(contents.datagrams.size() == static_cast<std::size_t>(whole));
    REQUIRE(contents.faults.count() == (at_an_end ? 0 : 1));
  }
}

TEST_CASE("another version of a .kmall datagram keeps its bytes and is no fault") {
  Bytes bytes;
  const Datagram older{.type = "#MRZ", .header = {.version = 0}, .body = Raw{Bytes(300, std::byte{0xFF})}};
  append(bytes, older);
  const Contents contents = read(bytes);
  CHECK(contents.faults.count() == 0);
  CHECK(std::holds_alternative<Raw>(contents.datagrams.at(0).body));
  CHECK(written(contents.datagrams) == bytes);
}

TEST_CASE("a .kmall body that is not what its sizes say keeps its bytes and is noted") {
  Bytes bytes;
  const Datagram lying{.type = "#MRZ", .header = {.version = 3}, .body = Raw{Bytes(300, std::byte{0xFF})}};
  append(bytes, lying);
  const Contents contents = read(bytes);
  CHECK(contents.faults.count() == 1);
  CHECK(std::holds_alternative<Raw>(contents.datagrams.at(0).body));
  CHECK(written(contents.datagrams) == bytes);
}
