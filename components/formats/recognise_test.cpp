#include "components/formats/recognise.h"

#include <catch2/catch.hpp>

#include "components/formats/all/installation_text.h"
#include "components/formats/all/writer.h"
#include "components/formats/kmall/installation_text.h"
#include "components/formats/testing/sample.h"

using namespace ensonify::formats;

namespace {

Format format_of(ByteView bytes) {
  Window file(bytes);
  return recognise(file);
}

}  // namespace

TEST_CASE("a format is recognised by content, also where the first datagram is damaged") {
  const sample::File all = sample::all_file(), kmall = sample::kmall_file(), xtf = sample::xtf_file();
  for (const bool damaged : {false, true}) {
    for (const auto& [file, format] : {std::pair{&all, Format::all}, {&kmall, Format::kmall}, {&xtf, Format::xtf}}) {
      Bytes bytes = file->bytes;
      if (damaged) bytes[file->offsets[0] + 4] ^= std::byte{0x40};
      CHECK(format_of(bytes) == format);
    }
  }
  CHECK(format_of(ByteView(xtf.bytes).first(1024)) == Format::xtf);  // a header and no packet
}

TEST_CASE("a .all file that begins like XTF and carries XTF is .all") {
  const auto carrying = [](Bytes body) {
    return all::Datagram{.type = '3', .header = {2040, 20260310, 0, 1, 157}, .body = Raw{std::move(body)}};
  };
  const sample::File xtf = sample::xtf_file();
  Bytes bytes;
  all::append(bytes, carrying(Bytes(104)));  // with header, marks and checksum 123 bytes
  REQUIRE(bytes[0] == std::byte{123});
  all::append(bytes, carrying(Bytes(2'000)));
  all::append(bytes, carrying(Bytes(xtf.bytes.begin() + 1024, xtf.bytes.end())));
  CHECK(format_of(bytes) == Format::all);
}

TEST_CASE("empty, foreign and cut files have no format") {
  CHECK(format_of({}) == Format::unknown);
  CHECK(format_of(Bytes(5'000, std::byte{0})) == Format::unknown);
  CHECK(format_of(Bytes(5'000, std::byte{123})) == Format::unknown);
  CHECK(format_of(ByteView(sample::all_file().bytes).first(20)) == Format::unknown);
  CHECK(format_of(ByteView(sample::kmall_file().bytes).first(20)) == Format::unknown);
  CHECK(format_of(ByteView(sample::xtf_file().bytes).first(1023)) == Format::unknown);
}

TEST_CASE("installation texts are read pair by pair, group by group") {
  const auto values = all::installation_values(std::string_view("WLZ=1.5,odd,S1X=-2,\0", 20));
  REQUIRE(values.size() == 2);
  CHECK(values[1] == std::pair<std::string, std::string>("S1X", "-2"));
  const auto groups = kmall::installation_groups("SN=5,\nSYSTEM:EM 2040,TRAI_RX1:N=1;X=0.5;odd;Z=2,POSI_2:U=NOT_SET,");
  REQUIRE(groups.size() == 3);
  CHECK((groups[0].name == "SYSTEM" && groups[0].text == "EM 2040"));
  CHECK(groups[1].values == std::vector<std::pair<std::string, std::string>>{{"N", "1"}, {"X", "0.5"}, {"Z", "2"}});
}
