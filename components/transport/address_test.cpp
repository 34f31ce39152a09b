#include "components/transport/address.h"

#include <catch2/catch.hpp>

#include "components/errors/exit_error.h"

using namespace ensonify;
using Catch::Matchers::Contains;

namespace {

Address ipv4(std::uint8_t a, std::uint8_t b, std::uint8_t c, std::uint8_t d, std::uint16_t port) {
  Address address;
  address.bytes = {a, b, c, d};
  address.port = port;
  return address;
}

}  // namespace

TEST_CASE("an address has a host and a port, and a port alone is of this machine") {
  CHECK(udp_address("192.168.1.20:16101") == ipv4(192, 168, 1, 20, 16101));
  CHECK(udp_address("localhost:1") == ipv4(127, 0, 0, 1, 1));
  CHECK(udp_address("65535") == ipv4(127, 0, 0, 1, 65535));
  CHECK(text_of(udp_address("239.1.2.3:6020")) == "239.1.2.3:6020");
  CHECK(udp_address("224.0.0.1:1").multicast());
  CHECK(udp_address("239.255.255.255:1").multicast());
  CHECK_FALSE(udp_address("240.0.0.1:1").multicast());
  CHECK(interface_address("10.0.0.1") == ipv4(10, 0, 0, 1, 0));
  CHECK(host_address("0.0.0.0").any());
}

TEST_CASE("an IPv6 address stands in brackets before a port, and may name its interface") {
  CHECK(text_of(udp_address("[::1]:16101")) == "[::1]:16101");
  CHECK(text_of(receiver_address("fd00::7", 10110)) == "[fd00::7]:10110");
  CHECK(host_address("::1", 5) == host_address("[0:0:0:0:0:0:0:1]", 5));
  CHECK(host_address("::").any());
  CHECK(udp_address("[ff02::1]:9").multicast());
  CHECK_FALSE(udp_address("[fd00::1]:9").multicast());
  CHECK(host_of(host_address("fe80::1%lo")) == "[fe80::1%lo]");  // every Linux has it
  CHECK_FALSE(host_address("fe80::1%lo") == host_address("fe80::1"));
  CHECK_THROWS_WITH(host_address("fe80::1%no_such"), Contains("with an interface of this machine"));
}

TEST_CASE("a host that is none is refused with what is allowed") {
  for (const char* text : {":16101", "ship:16101", "1.2.3:16101", "1.2.3.256:16101", "0.0.0.0:1", "255.255.255.255:1",
                           "1.2.3.4:5:16101", "[::]:1", "[::1:16101", "::1:16101", "[1.2.3.4]:1", "[::1%eth99]:1"}) {
    CAPTURE(text);
    CHECK_THROWS_WITH(udp_address(text), Contains("is no host; allowed: an IPv4 address as 192.168.1.20"));
  }
  for (const char* text : {"", "eth0", "239.1.2.3", "0.0.0.0", "::1"}) {
    CAPTURE(text);
    CHECK_THROWS_WITH(interface_address(text), Contains("is no address of an interface; allowed: its IPv4 address"));
  }
  CHECK_THROWS_WITH(host_address("somebody"), Contains("\"somebody\" is no address; allowed: one such as 127.0.0.1"));
}

TEST_CASE("a port that is none is refused with what is allowed") {
  for (const char* text : {"", "0", "65536", "127.0.0.1:", "127.0.0.1:0", "127.0.0.1:-1", "127.0.0.1:16101x",
                           "127.0.0.1: 16101", "99999999999999999999", "[::1]:", "[::1]:0"}) {
    CAPTURE(text);
    CHECK_THROWS_WITH(udp_address(text), Contains("is no port; allowed: 1 to 65535"));
  }
}
