#include <sys/socket.h>

#include <catch2/catch.hpp>

#include "components/errors/exit_error.h"
#include "components/transport/receiver.h"
#include "components/transport/sender.h"
#include "components/transport/testing/loopback.h"
#include "components/transport/udp_sender.h"

using namespace ensonify;
using Outcome = Sender::Outcome;

namespace {

const Senders kThisMachine({"::1"});

bool has_ipv6() {
  const Descriptor probe = socket_of(Address::Family::kIpv6, SOCK_DGRAM);
  const SocketAddress own(host_address("::1"));
  if (probe.is_open() && ::bind(probe.get(), own.data(), own.size()) == 0) return true;
  WARN("skipped: this machine has no IPv6 address ::1");
  return false;
}

Outcome send(Sender& sender, const std::string& text) { return sender.send(std::as_bytes(std::span(text))); }

}  // namespace

TEST_CASE("datagrams go over IPv6, and one of a sender that is not named is refused") {
  if (!has_ipv6()) return;
  const int port = free_port(SOCK_DGRAM);
  Receiver receiver(udp_channel("::1", port, kThisMachine));
  UdpSender sender(udp_address("[::1]:" + std::to_string(port)), interface_address("localhost"), 1);
  CHECK(send(sender, "$A*00\r\n") == Outcome::sent);
  CHECK(received(receiver, 7) == "$A*00\r\n");
  const int other = free_port(SOCK_DGRAM);
  Receiver closed(udp_channel("[::1]", other, Senders({"fd00::7", "127.0.0.1"})));
  UdpSender stranger(receiver_address("::1", other), interface_address("localhost"), 1);
  CHECK(send(stranger, "stranger") == Outcome::sent);
  CHECK(comes_true([&] { return closed.state().refused == 1; }));
}

TEST_CASE("connections go over IPv6, either end first") {
  if (!has_ipv6()) return;
  const int out = free_port(SOCK_STREAM), in = free_port(SOCK_STREAM);
  const auto server = tcp_server_sender("::1", out, kThisMachine);
  Receiver client(tcp_client_channel("::1", out));
  REQUIRE(comes_true([&] { return send(*server, "1") == Outcome::sent; }));
  CHECK(received(client, 1) == "1");

  const auto sender = tcp_client_sender("::1", in);
  CHECK(send(*sender, "nobody") == Outcome::unreachable);
  Receiver receiver(tcp_server_channel("::1", in, kThisMachine));
  REQUIRE(comes_true([&] { return send(*sender, "x") == Outcome::sent && receiver.take().has_value(); }));
}

TEST_CASE("IPv6 takes nothing of IPv4: both may have the same port") {
  if (!has_ipv6()) return;
  const int port = free_port(SOCK_DGRAM);
  Receiver six(udp_channel("::", port, kThisMachine)), four(udp_channel("0.0.0.0", port, Senders({"127.0.0.1"})));
  UdpSender sender(receiver_address("127.0.0.1", port), interface_address("localhost"), 1);
  CHECK(send(sender, "four") == Outcome::sent);
  CHECK(received(four, 4) == "four");
  CHECK_FALSE(six.take());
}

TEST_CASE("no connection over IPv6 says to where, in brackets") {
  CHECK(tcp_client_channel("::1", 4001)->trouble() == "no connection to [::1]:4001");
}
