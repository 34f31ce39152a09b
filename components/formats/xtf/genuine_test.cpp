// A genuine sidescan file, read and written again. Where the folder of data is absent, the cases say so and pass.
#include <catch2/catch.hpp>

#include "components/formats/testing/contents.h"
#include "components/formats/testing/sample.h"
#include "components/formats/xtf/reader.h"
#include "components/formats/xtf/writer.h"

using namespace ensonify::formats;
using namespace ensonify::formats::xtf;
using Catch::Matchers::WithinAbs;

namespace {

constexpr const char* kName = "sonar/scotsman-iver2.xtf";

bool missing() {
  if (sample::genuine(kName)) return false;
  WARN("skipped: no data/sonar/scotsman-iver2.xtf in the folder that ENSONIFY_SHARED names");
  return true;
}

double mean(ByteView samples) {
  ByteSource in(samples);
  const std::size_t count = samples.size() / sizeof(std::uint16_t);
  double sum = 0;
  for (std::size_t i = 0; i < count; ++i) sum += in.number<std::uint16_t>();
  return sum / static_cast<double>(count);
}

}  // namespace

TEST_CASE("a genuine XTF file read and written again is the same bytes") {
  if (missing()) return;
  Window file(*sample::genuine(kName));
  Reader reader(file);
  REQUIRE(reader.header());
  Bytes written;
  append(written, *reader.header());
  while (const auto packet = reader.next()) {
    REQUIRE(std::holds_alternative<SonarPing>(packet->body));
    append(written, *packet);
  }
  CHECK(reader.faults().count() == 0);
  CHECK(written == sample::bytes_of(*sample::genuine(kName)));
}

TEST_CASE("a genuine ping's range is its duration at half the sound speed, and port comes far range first") {
  if (missing()) return;
  Window file(*sample::genuine(kName));
  const auto contents = sample::contents_of<Packet, Reader>(file);
  REQUIRE(contents.datagrams.size() == 461);
  double port_far = 0, port_near = 0, starboard_far = 0, starboard_near = 0;
  for (const Packet& packet : contents.datagrams) {
    const auto& ping = std::get<SonarPing>(packet.body);
    REQUIRE(ping.channels.size() == 2);
    const Channel& port = ping.channels[0];
    CHECK(ping.header.sound_speed_mps() == 1500);
    CHECK_THAT(port.duration_s * ping.header.half_sound_speed_mps, WithinAbs(port.slant_range_m, 1e-3));
    CHECK(port.samples.size() == 2048);
    const ByteView first = port.samples, second = ping.channels[1].samples;
    // Of 2048 bytes, 64 are the transmitted pulse; 128 behind it are of water.
    port_far += mean(first.first(128));
    port_near += mean(first.last(64 + 128).first(128));
    starboard_near += mean(second.subspan(64, 128));
    starboard_far += mean(second.last(128));
  }
  CHECK(port_near < port_far / 10);
  CHECK(starboard_near < starboard_far / 10);
  // 10 September 2013, 21:13:08 UTC.
  CHECK(contents.datagrams[0].unix_ns().value() == 1'378'847'588'000'000'000);
}
