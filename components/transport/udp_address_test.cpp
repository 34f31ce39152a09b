#include "components/transport/udp_address.h"

#include <catch2/catch.hpp>

#include "components/errors/exit_error.h"

using namespace ensonify;
using Catch::Matchers::Contains;

TEST_CASE("an address has a host and a port, and a port alone is of this machine") {
  CHECK(udp_address("192.168.1.20:16101") == UdpAddress{0xC0A80114, 16101});
  CHECK(udp_address("localhost:1") == UdpAddress{0x7F000001, 1});
  CHECK(udp_address("65535") == UdpAddress{0x7F000001, 65535});
  CHECK(text_of(udp_address("239.1.2.3:6020")) == "239.1.2.3:6020");
  CHECK(udp_address("224.0.0.1:1").multicast());
  CHECK(udp_address("239.255.255.255:1").multicast());
  CHECK_FALSE(udp_address("240.0.0.1:1").multicast());
  CHECK(interface_address("10.0.0.1") == UdpAddress{0x0A000001, 0});
}

TEST_CASE("a host that is none is refused with what is allowed") {
  for (const char* text : {":16101", "ship:16101", "1.2.3:16101", "1.2.3.256:16101", "0.0.0.0:1", "255.255.255.255:1",
                           "[::1]:16101", "1.2.3.4:5:16101"}) {
    CAPTURE(text);
    CHECK_THROWS_WITH(udp_address(text), Contains("is no host; allowed: an IPv4 address as 192.168.1.20"));
  }
  for (const char* text : {"", "eth0", "239.1.2.3", "0.0.0.0"}) {
    CAPTURE(text);
    CHECK_THROWS_WITH(interface_address(text), Contains("is no address of an interface; allowed: its IPv4 address"));
  }
}

TEST_CASE("a port that is none is refused with what is allowed") {
  for (const char* text : {"", "0", "65536", "127.0.0.1:", "127.0.0.1:0", "127.0.0.1:-1", "127.0.0.1:16101x",
                           "127.0.0.1: 16101", "99999999999999999999"}) {
    CAPTURE(text);
    CHECK_THROWS_WITH(udp_address(text), Contains("is no port; allowed: 1 to 65535"));
  }
}
