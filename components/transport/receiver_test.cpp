#include "components/transport/receiver.h"

#include <fcntl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cstdlib>

#include "components/errors/exit_error.h"
#include "components/transport/descriptor.h"
#include "components/transport/testing/loopback.h"

using namespace ensonify;
using namespace std::chrono_literals;

namespace {

const Senders kThisMachine({"127.0.0.1"});

Descriptor connected(int type, int port, const std::string& from = "127.0.0.1") {
  Descriptor out(::socket(AF_INET, type, 0));
  const SocketAddress own(host_address(from)), other(host_address("127.0.0.1", port));
  REQUIRE(::bind(out.get(), own.data(), own.size()) == 0);
  if (::connect(out.get(), other.data(), other.size()) != 0) out.reset();
  return out;
}

void send(const Descriptor& out, const std::string& bytes) {
  std::size_t sent = 0;
  while (sent < bytes.size()) {
    const ssize_t now = ::write(out.get(), bytes.data() + sent, std::min<std::size_t>(bytes.size() - sent, 60000));
    REQUIRE(now > 0);
    sent += static_cast<std::size_t>(now);
  }
}

}  // namespace

TEST_CASE("a datagram comes whole, with the time at which it came") {
  const int port = free_port(SOCK_DGRAM);
  Receiver receiver(udp_channel("127.0.0.1", port, kThisMachine));
  const auto out = connected(SOCK_DGRAM, port);
  const auto before = Receiver::Clock::now();
  send(out, "$A*00\r\n");
  std::this_thread::sleep_for(200ms);  // asked for late, stamped when it came
  const auto arrival = receiver.take();
  REQUIRE(arrival);
  CHECK(arrival->piece.bytes == "$A*00\r\n");
  CHECK(arrival->piece.whole);
  CHECK(arrival->at - before < 150ms);
  CHECK_FALSE(receiver.take());
  const std::string large(60000, 'x');
  send(out, large);
  CHECK(received(receiver, large.size()) == large);
}

TEST_CASE("senders that are not named are refused and counted") {
  const int udp = free_port(SOCK_DGRAM), tcp = free_port(SOCK_STREAM);
  Receiver datagrams(udp_channel("127.0.0.1", udp, kThisMachine));
  Receiver server(tcp_server_channel("127.0.0.1", tcp, kThisMachine));
  send(connected(SOCK_DGRAM, udp, "127.0.0.2"), "stranger");
  CHECK(comes_true([&] { return datagrams.state().refused == 1; }));
  send(connected(SOCK_DGRAM, udp), "friend");
  CHECK(received(datagrams, 6) == "friend");
  const auto stranger = connected(SOCK_STREAM, tcp, "127.0.0.2");
  CHECK(comes_true([&] { return server.state().refused == 1; }));
  const auto friendly = connected(SOCK_STREAM, tcp);
  send(friendly, "friend");
  CHECK(received(server, 6) == "friend");
  const auto second = connected(SOCK_STREAM, tcp);  // while the first one is there
  CHECK(comes_true([&] { return server.state().refused == 2; }));
}

TEST_CASE("a TCP sender may go and come again: what it sends then begins anew") {
  const int port = free_port(SOCK_STREAM);
  Receiver server(tcp_server_channel("127.0.0.1", port, kThisMachine));
  CHECK(server.state().trouble == "nobody is connected to TCP port " + std::to_string(port));
  for (int i = 0; i < 2; ++i) {
    auto out = connected(SOCK_STREAM, port);
    send(out, "half a sent");
    std::optional<Receiver::Arrival> arrival;
    REQUIRE(comes_true([&] { return (arrival = server.take()).has_value(); }));
    CHECK(arrival->piece.begins);
    CHECK(server.state().trouble.empty());
    out.reset();
    CHECK(comes_true([&] { return !server.state().trouble.empty(); }));
  }
}

TEST_CASE("a TCP client waits for its server, and comes back to it") {
  const int port = free_port(SOCK_STREAM);
  Receiver client(tcp_client_channel("127.0.0.1", port));
  CHECK(client.state().trouble == "no connection to 127.0.0.1:" + std::to_string(port));
  for (int i = 0; i < 2; ++i) {
    Descriptor listener(::socket(AF_INET, SOCK_STREAM, 0));
    const int yes = 1;
    ::setsockopt(listener.get(), SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    const SocketAddress own(host_address("127.0.0.1", port));
    REQUIRE(::bind(listener.get(), own.data(), own.size()) == 0);
    ::listen(listener.get(), 1);
    const Descriptor accepted(::accept(listener.get(), nullptr, nullptr));
    send(accepted, "hello");
    CHECK(received(client, 5) == "hello");
  }
}

TEST_CASE("a serial line gives every byte as it comes") {
  const Descriptor master(::posix_openpt(O_RDWR | O_NOCTTY));
  REQUIRE(::grantpt(master.get()) == 0);
  REQUIRE(::unlockpt(master.get()) == 0);
  Receiver line(serial_channel(::ptsname(master.get()), 38400));
  std::string every;
  for (int byte = 0; byte < 256; ++byte) every += static_cast<char>(byte);
  send(master, every);
  CHECK(received(line, every.size()) == every);
}

TEST_CASE("a flood is kept up to a bound, and what is dropped is counted") {
  const int port = free_port(SOCK_STREAM);
  Receiver server(tcp_server_channel("127.0.0.1", port, kThisMachine));
  const auto out = connected(SOCK_STREAM, port);
  constexpr std::size_t kSent = 6U << 20U;  // nobody takes any
  send(out, std::string(kSent, 'x'));
  CHECK(comes_true([&] { return server.state().dropped_bytes >= kSent - Receiver::kMostBytes; }));
  CHECK(received(server, kSent - server.state().dropped_bytes).size() == kSent - server.state().dropped_bytes);
}

TEST_CASE("what cannot be opened is a mistake of the user's, with what is allowed") {
  const int udp = free_port(SOCK_DGRAM);
  const auto taken = udp_channel("127.0.0.1", udp, kThisMachine);
  CHECK_THROWS_WITH(udp_channel("127.0.0.1", udp, kThisMachine),
                    Catch::Contains("cannot listen to UDP port") && Catch::Contains("allowed: a port that is free"));
  CHECK_THROWS_WITH(serial_channel("/dev/no_such_line", 9600), Catch::Contains("cannot open the serial line"));
  CHECK_THROWS_WITH(serial_channel("/dev/null", 1234), Catch::Contains("1234 baud"));
  CHECK_THROWS_WITH(Senders({"somebody"}),
                    Catch::Contains("\"somebody\" is no address; allowed: one such as 127.0.0.1"));
}
