#include "components/formats/all/reader.h"

#include <catch2/catch.hpp>
#include <map>
#include <set>

#include "components/formats/all/writer.h"
#include "components/formats/testing/contents.h"
#include "components/formats/testing/sample.h"

using namespace ensonify::formats;
using namespace ensonify::formats::all;

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

TEST_CASE("every datagram that we write is read back and written again as it was") {
  const sample::File file = sample::all_file();
  const Contents contents = read(file.bytes);
  CHECK(contents.faults.count() == 0);
  REQUIRE(contents.datagrams.size() == file.offsets.size());
  std::set<std::size_t> alternatives;
  for (const Datagram& datagram : contents.datagrams) alternatives.insert(datagram.body.index());
  CHECK(alternatives.size() == std::variant_size_v<Body> - 1);  // all but Raw
  CHECK(written(contents.datagrams) == file.bytes);
}

TEST_CASE("datagrams are even in length, but for the installation") {
  for (const Datagram& datagram : read(sample::all_file().bytes).datagrams) {
    Bytes frame;
    append(frame, datagram);
    CAPTURE(datagram.type);
    if (datagram.type != 'I' && datagram.type != 'i') CHECK(frame.size() % 2 == 0);
  }
}

TEST_CASE("the four datagrams of a ping share number, serial and time") {
  std::map<std::uint16_t, std::string> types;
  for (const Datagram& datagram : read(sample::all_file().bytes).datagrams) {
    if (std::string("NXYk").find(datagram.type) == std::string::npos) continue;
    types[datagram.header.counter] += datagram.type;
    CHECK(datagram.header.serial == 157);
    CHECK(datagram.unix_ns() == sample::kBegin_ns + datagram.header.counter * std::int64_t{100'000'000});
  }
  CHECK(types == std::map<std::uint16_t, std::string>{{7, "NXYk"}, {8, "NXYk"}});
}

TEST_CASE("any flipped bit costs one datagram and is noted") {
  const sample::File file = sample::all_file();
  const Contents whole = read(file.bytes);
  for (std::size_t at = 0; at < file.bytes.size(); ++at) {
    for (const int bit : {0, 3, 7}) {
      CAPTURE(at, bit);
      Bytes damaged = file.bytes;
      damaged[at] ^= std::byte(1U << bit);
      const Contents contents = read(damaged);
      REQUIRE(contents.faults.count() > 0);
      REQUIRE(contents.faults.kept()[0].offset <= at);
      REQUIRE(contents.datagrams.size() == whole.datagrams.size() - 1);
      for (const Datagram& datagram : contents.datagrams) {
        Bytes frame;
        append(frame, datagram);
        REQUIRE(
            std::equal(frame.begin(), frame.end(), file.bytes.begin() + static_cast<std::ptrdiff_t>(datagram.offset)));
      }
    }
  }
}

TEST_CASE("a file cut anywhere gives what is whole and says where it ends") {
  const sample::File file = sample::all_file();
  for (std::size_t bytes = 0; bytes < file.bytes.size(); bytes += 7) {
    CAPTURE(bytes);
    const Contents contents = read(ByteView(file.bytes).first(bytes));
    const auto begun = std::upper_bound(file.offsets.begin(), file.offsets.end(), bytes) - file.offsets.begin();
    const bool at_an_end =
        bytes == 0 || std::find(file.offsets.begin(), file.offsets.end(), bytes) != file.offsets.end();
    REQUIRE(contents.faults.count() == (at_an_end ? 0 : 1));
    REQUIRE(contents.datagrams.size() == static_cast<std::size_t>(std::max<std::ptrdiff_t>(begun - 1, 0)));
    if (!at_an_end) REQUIRE(contents.faults.kept()[0].offset == file.offsets[contents.datagrams.size()]);
  }
}

TEST_CASE("a fault names what stands there and what is allowed") {
  sample::File file = sample::all_file();
  const auto second = file.offsets[1];
  const std::size_t end = file.offsets[2];
  Bytes wrong_sum = file.bytes;
  wrong_sum[end - 1] ^= std::byte{1};
  Bytes wrong_end = file.bytes;
  wrong_end[end - 3] = std::byte{7};
  Bytes too_long = file.bytes;
  replace_number(too_long, second, std::uint32_t{0xFFFFFFFF});
  Bytes beyond = file.bytes;
  replace_number(beyond, second, std::uint32_t{100'000});
  Bytes bad_date = file.bytes;
  replace_number(bad_date, second + 8, std::uint32_t{20261340});
  const auto cause = [&](ByteView bytes) {
    const Contents contents = read(bytes);
    REQUIRE(contents.faults.count() == 1);
    CHECK(contents.faults.kept()[0].offset == second);
    CHECK(contents.faults.skipped_bytes() == end - second);
    return contents.faults.kept()[0].cause;
  };
  CHECK(cause(wrong_sum).find("the checksum is ") == 0);
  CHECK(cause(wrong_end) == "the end mark is 7, must be 3");
  CHECK(cause(too_long) == "the length is 4294967295, must be 19 to 1048576");
  CHECK(cause(beyond) == "the length is 100000, must be at most what is left of the file");
  CHECK(cause(bad_date) == "the date is 20261340, must be year, month and day as 20171214");
}

TEST_CASE("a whole frame whose counts lie keeps its bytes and is noted") {
  Bytes bytes;
  const Datagram lying{.type = 'X', .header = {2040, 20260310, 0, 1, 157}, .body = Raw{Bytes(40, std::byte{0xFF})}};
  append(bytes, lying);
  const Contents contents = read(bytes);
  REQUIRE(contents.datagrams.size() == 1);
  CHECK(std::holds_alternative<Raw>(contents.datagrams[0].body));
  CHECK(contents.faults.count() == 1);
  CHECK(contents.faults.skipped_bytes() == 0);
  CHECK(written(contents.datagrams) == bytes);
}

TEST_CASE("a damaged datagram's body is not searched where its length is right") {
  // Files within files: what a datagram carries is its own, damaged or not.
  const sample::File inner = sample::all_file();
  Bytes bytes;
  append(bytes, {.type = '3', .header = {2040, 20260310, 0, 1, 157}, .body = Raw{inner.bytes}});
  const std::size_t end = bytes.size();
  append(bytes, {.type = 'h', .header = {2040, 20260310, 0, 1, 157}, .body = Height{}});
  bytes[end - 1] ^= std::byte{1};
  const Contents contents = read(bytes);
  REQUIRE(contents.datagrams.size() == 1);
  CHECK(contents.datagrams[0].type == 'h');
  CHECK(contents.faults.skipped_bytes() == end);
}

TEST_CASE("foreign bytes hold no datagram and one fault") {
  Bytes bytes(100'000);
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::byte>(i * i % 251);
  const Contents contents = read(bytes);
  CHECK(contents.datagrams.empty());
  CHECK(contents.faults.count() == 1);
  CHECK(contents.faults.skipped_bytes() == bytes.size());
}

TEST_CASE("a file on disk longer than the window reads as bytes in memory do") {
  const sample::File one = sample::all_file();
  Bytes many;
  const std::size_t copies = 3 * Window::kReadAhead / one.bytes.size();
  for (std::size_t i = 0; i < copies; ++i) many.insert(many.end(), one.bytes.begin(), one.bytes.end());
  const sample::TemporaryFile disk(many);
  Window file(disk.path());
  Reader reader(file);
  std::size_t datagrams = 0;
  while (reader.next()) ++datagrams;
  CHECK(datagrams == copies * one.offsets.size());
  CHECK(reader.faults().count() == 0);
}
