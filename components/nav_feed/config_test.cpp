#include "components/nav_feed/config.h"

#include <catch2/catch.hpp>

#include "components/config/config_reader.h"
#include "components/config/read_parameters.h"

using namespace ensonify;

namespace {

NavFeedParameters read(const std::string& yaml) {
  ConfigReader from = ConfigReader::from_text(yaml, "feed.yaml");
  NavFeedParameters parameters;
  read_parameters(from, parameters);
  from.finish();
  return parameters;
}

}  // namespace

TEST_CASE("sources are read by names, each with its own way, arms, signs and time scale") {
  const auto feed = read(
      "sources:\n"
      "  gnss: {tcp: 4001, of: 10.0.0.7, motion: false, antenna_position_m: [1, 2, -3], time_scale: gps}\n"
      "  mru: {serial: /dev/ttyUSB0, baud: 19200, format: tss1, roll_reversed: true, latency_s: 0.02}\n");
  REQUIRE(feed.sources.size() == 2);
  CHECK(std::get<FeedSource::TcpClient>(feed.sources[0].way).address == "10.0.0.7");
  CHECK(feed.sources[0].antenna_body_m.z() == -3.0);
  CHECK(feed.sources[1].name == "mru");
  CHECK(std::get<FeedSource::Serial>(feed.sources[1].way).baud == 19200);
  CHECK(feed.sources[1].roll_reversed);
}

TEST_CASE("sources that cannot work together are mistakes with their place") {
  CHECK_THROWS_WITH(read("sources: {a: {udp: 4001}, b: {udp: 4002}}"),
                    Catch::Contains("sources.b.place: places come from a already; one of them needs place: false"));
  CHECK_THROWS_WITH(read("sources: {mru: {udp: 4001, format: tss1}}"), Catch::Contains("sources: none gives places"));
  CHECK_THROWS_WITH(read("sources: {a: {format: nmea}}"), Catch::Contains("needs one of"));
  CHECK_THROWS_WITH(read("sources: {a: {udp: 4001, tcp: 4002}}"), Catch::Contains("sources.a"));
}

TEST_CASE("addresses that are none, and senders that cannot reach the source, are mistakes with their place") {
  CHECK_NOTHROW(read("sources: {a: {udp: 4001, at: '::1', senders: ['::1']}}"));
  CHECK_NOTHROW(read("sources: {a: {tcp: 4001, of: '[fd00::7]'}}"));
  CHECK_THROWS_WITH(
      read("sources: {a: {udp: 4001, at: '::1'}}"),
      Catch::Contains("sources.a.senders: none may send to [::1]; allowed: at least one IPv6 address as ::1"));
  CHECK_THROWS_WITH(read("sources: {a: {udp: 4001, at: bridge}}"),
                    Catch::Contains("sources.a.at: \"bridge\" is no address; allowed: one such as 127.0.0.1, ::1"));
  CHECK_THROWS_WITH(read("sources: {a: {udp: 4001, senders: [127.0.0.1, gyro]}}"),
                    Catch::Contains("sources.a.senders: \"gyro\" is no address"));
  CHECK_THROWS_WITH(read("sources: {a: {tcp: 4001, of: '::1:4001:'}}"),
                    Catch::Contains("sources.a.of: \"::1:4001:\" is no host"));
}
