#include "tools/info/summary.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "components/errors/exit_error.h"
#include "components/formats/all/reader.h"
#include "components/formats/all/writer.h"
#include "components/formats/testing/sample.h"
#include "tools/info/print.h"
#include "tools/info/summarise.h"

using namespace ensonify;
using namespace ensonify::info;
using Catch::Matchers::Contains;
using Catch::Matchers::WithinAbs;

namespace {

Summary summary_of(formats::ByteView bytes) {
  formats::Window file(bytes);
  return summarise(file);
}

}  // namespace

TEST_CASE("an extent across the antimeridian goes from west to east by the short way") {
  Extent extent;
  extent.add(-17.0, 179.9);
  extent.add(-17.1, -179.8);
  extent.add(0.0, 0.0);
  extent.add(NAN, 10.0);
  extent.add(200.0, 200.0);
  CHECK_THAT(extent.west_deg(), WithinAbs(179.9, 1e-9));
  CHECK_THAT(extent.east_deg(), WithinAbs(-179.8, 1e-9));
  CHECK(extent.latitude_deg().low == -17.1);
  CHECK(extent.unusable() == 3);
}

TEST_CASE("missing pings are counted across the end of the counter, out of order too") {
  Pings pings;
  std::int64_t time_ns = 0;
  for (const int number : {65'533, 65'535, 65'534, 0, 4, 3})
    pings.add_modulo(static_cast<std::uint16_t>(number), ++time_ns);
  const auto gaps = pings.gaps();
  REQUIRE(gaps.size() == 1);
  CHECK(gaps[0].first == 1);
  CHECK(gaps[0].count == 2);
  CHECK(gaps[0].after_ns == 4);
  CHECK(pings.count() == 6);
}

TEST_CASE("a ping before the first one of a file is no gap of 65 thousand") {
  Pings pings;
  pings.add_modulo(0, 1);
  pings.add_modulo(65'535, 2);
  pings.add_modulo(1, 3);
  CHECK(pings.gaps().empty());
}

TEST_CASE("a stream's rate is that of its values, its longest gap has a time") {
  Stream stream;
  for (const std::int64_t time_ms : {0, 100, 200, 700, 600}) stream.add(time_ms * 1'000'000);
  CHECK_THAT(stream.rate_hz(), WithinAbs(4 / 0.7, 1e-9));
  CHECK(stream.longest_gap_ns == 500'000'000);
  CHECK(stream.gap_begin_ns == 200'000'000);
  CHECK(stream.backward == 1);
}

TEST_CASE("a ping without X is missed also after its number has come before") {
  formats::all::Writer writer(2040, 1);
  formats::Bytes bytes;
  const auto ping = [&](bool whole) {
    writer.append_ping(bytes, formats::sample::kBegin_ns, 7, 1, formats::all::RawRangeAngle{});
    if (whole) writer.append_ping(bytes, formats::sample::kBegin_ns, 7, 1, formats::all::Soundings{});
    writer.append_ping(bytes, formats::sample::kBegin_ns, 7, 1, formats::all::SeabedImage{});
  };
  for (const bool whole : {true, false, true}) ping(whole);
  formats::Window file(bytes);
  const auto notes = summarise(file).notes;
  CHECK(std::count(notes.begin(), notes.end(), "pings without all of N, X and Y: 1; there are 3 N, 2 X and 3 Y") == 1);
}

TEST_CASE("a step back is held against the value before, of the same sensor") {
  Stream stream;
  for (const std::int64_t time_ns : {10, 5, 6, 7}) stream.add(time_ns);
  CHECK(stream.backward == 1);
  Stream two;
  for (std::int64_t i = 0; i < 10; ++i) {
    two.add(1'000'000'000 * (i + 1), 0);
    two.add(1'000'000'000 * i, 1);  // late by a second
  }
  CHECK(two.backward == 0);
  CHECK_THAT(two.rate_hz(), WithinAbs(0.9, 1e-9));  // nine steps of each within ten seconds
}

TEST_CASE("what a .all file and a .kmall file of one seabed say agrees") {
  const Summary all = summary_of(formats::sample::all_file().bytes);
  const Summary kmall = summary_of(formats::sample::kmall_file().bytes);
  for (const Summary* summary : {&all, &kmall}) {
    CAPTURE(summary->format);
    CHECK(summary->faults.count() == 0);
    CHECK(summary->notes.empty());
    // 20 m below a transmitter that is 1 m below the water line.
    CHECK_THAT(summary->depth_m.low, WithinAbs(21.0, 1e-4));
    CHECK_THAT(summary->depth_m.high, WithinAbs(21.0, 1e-4));
    CHECK_THAT(summary->extent.latitude_deg().low, WithinAbs(54.0, 1e-6));
    CHECK(summary->positions.count == 3);
    REQUIRE(summary->pings.size() == 1);
    CHECK(summary->pings.begin()->second.count() == 2);
    CHECK(summary->pings.begin()->second.gaps().empty());
    REQUIRE(summary->water_columns.size() == 1);
    CHECK(summary->water_columns.begin()->second.count() == (summary == &all ? 2 : 3));  // one more stands alone
    CHECK_THAT(text_of("file", *summary), Contains("\nwater column "));
    CHECK(summary->mountings.back().name == "water line");
    CHECK(summary->mountings.back().values.at(0).second.substr(0, 5) == "-0.40");
    CHECK(summary->datagrams.first_ns == formats::sample::kBegin_ns);
  }
}

TEST_CASE("a ping whose soundings are damaged is a fault, and not complete") {
  formats::sample::File file = formats::sample::all_file();
  formats::Window window(file.bytes);
  formats::all::Reader reader(window);
  std::size_t damaged_at = 0;
  while (const auto datagram = reader.next()) {
    if (datagram->type == 'X' && datagram->header.counter == 8) damaged_at = datagram->offset + 100;
  }
  REQUIRE(damaged_at > 0);
  file.bytes[damaged_at] ^= std::byte{1};
  const Summary summary = summary_of(file.bytes);
  CHECK(summary.faults.count() == 1);
  CHECK(summary.pings.at("serial 157").count() == 1);
  REQUIRE(summary.notes.size() == 1);
  CHECK(summary.notes[0] == "pings without all of N, X and Y: 1; there are 2 N, 1 X and 2 Y");
  CHECK_THAT(text_of("file", summary), Contains("faults      1, ") && Contains("the checksum is "));
}

TEST_CASE("an XTF file's pings are counted by head, and its depths are below the sensor") {
  const Summary summary = summary_of(formats::sample::xtf_file().bytes);
  CHECK(summary.pings.at("sidescan").count() == 3);
  CHECK(summary.pings.at("multibeam").count() == 3);
  CHECK(summary.depth_m.low == 12.0);
  CHECK(summary.attitudes.count == 3);
  CHECK(summary.mountings.at(0).name == "channel 0 port");
  CHECK(summary.notes.empty());
}

TEST_CASE("a file of no known format is refused with those that are known") {
  CHECK_THROWS_WITH(summary_of({}), "it is empty");
  const formats::Bytes foreign(1000, std::byte{'x'});
  const std::string_view mcap = "\x89MCAP0\r\nrest";
  CHECK_THROWS_WITH(summary_of(std::as_bytes(std::span(mcap))), Contains("it is an MCAP record"));
  CHECK_THROWS_WITH(summary_of(foreign), Contains("known are .all, .wcd, .kmall, .kmwcd and XTF"));
}

TEST_CASE("a foreign text reaches the terminal without control characters") {
  Summary summary;
  summary.system = "EM\x1b[2J";
  CHECK_THAT(text_of("file", summary), Contains("EM\\x1b[2J"));
}
