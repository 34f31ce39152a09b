#include "components/transport/sender.h"

#include <fcntl.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cstdlib>

#include "components/errors/exit_error.h"
#include "components/transport/testing/loopback.h"

using namespace ensonify;
using namespace std::chrono_literals;

namespace {

const Senders kThisMachine({"127.0.0.1"});
using Outcome = Sender::Outcome;

Outcome send(Sender& sender, const std::string& text) { return sender.send(std::as_bytes(std::span(text))); }

/// The master's end of a line, and the path of the other.
struct Line {
  Descriptor master{::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK)};
  std::string path;
  Line() {
    REQUIRE(::grantpt(master.get()) == 0);
    REQUIRE(::unlockpt(master.get()) == 0);
    path = ::ptsname(master.get());
  }
};

/// Lines of one length, numbered: what is lost or torn is found.
std::string numbered(int i) {
  std::string text = std::to_string(i);
  text.insert(0, 999 - text.size(), '.');
  return text + "\n";
}

}  // namespace

TEST_CASE("a TCP server sends to all that are connected, and to one that comes later from then on") {
  const int port = free_port(SOCK_STREAM);
  const auto server = tcp_server_sender("127.0.0.1", port, kThisMachine);
  CHECK(send(*server, "nobody") == Outcome::unreachable);
  Receiver first(tcp_client_channel("127.0.0.1", port));
  REQUIRE(comes_true([&] { return send(*server, "1") == Outcome::sent; }));
  CHECK(received(first, 1) == "1");
  {
    Receiver second(tcp_client_channel("127.0.0.1", port));
    REQUIRE(comes_true([&] { return second.state().trouble.empty(); }));
    CHECK(send(*server, "2") == Outcome::sent);
    CHECK(received(first, 1) == "2");
    CHECK(received(second, 1) == "2");
  }
  CHECK(comes_true([&] { return send(*server, "3") == Outcome::sent; }));
  CHECK(received(first, 1).starts_with('3'));
}

TEST_CASE("who may not connect to a TCP server is refused and counted") {
  const int port = free_port(SOCK_STREAM);
  const auto server = tcp_server_sender("127.0.0.1", port, Senders({"127.0.0.2"}));
  Receiver stranger(tcp_client_channel("127.0.0.1", port));
  REQUIRE(comes_true([&] {
    CHECK(send(*server, "secret") == Outcome::unreachable);
    return server->refused() > 0;
  }));
  CHECK(received(stranger, 1).empty());
}

TEST_CASE("a TCP client sends once its receiver is there, and again when it is back") {
  const int port = free_port(SOCK_STREAM);
  const auto client = tcp_client_sender("127.0.0.1", port);
  CHECK(send(*client, "nobody") == Outcome::unreachable);
  for (int i = 0; i < 2; ++i) {
    Receiver server(tcp_server_channel("127.0.0.1", port, kThisMachine));
    REQUIRE(comes_true([&] { return send(*client, "x") == Outcome::sent && server.take().has_value(); }));
  }
}

TEST_CASE("a receiver that does not read holds nobody up, and gets no torn lines when it reads again") {
  Line line;
  const auto serial = serial_sender(line.path, 115200);
  int busy_from = 0;
  while (send(*serial, numbered(busy_from)) == Outcome::sent) ++busy_from;
  CHECK(send(*serial, numbered(busy_from)) == Outcome::busy);
  std::string got;
  for (int next = busy_from; got.size() < 1000U * (busy_from + 20);) {
    const auto bytes = read_some(line.master);
    REQUIRE(bytes);
    got += *bytes;
    if (send(*serial, numbered(next)) == Outcome::sent) ++next;
  }
  for (int i = 0; i < busy_from + 20; ++i)
    REQUIRE(got.substr(1000U * static_cast<std::size_t>(i), 1000) == numbered(i));
}

TEST_CASE("a serial line takes every byte as it is") {
  Line line;
  const auto serial = serial_sender(line.path, 9600);
  std::string every;
  for (int byte = 0; byte < 256; ++byte) every += static_cast<char>(byte);
  CHECK(send(*serial, every) == Outcome::sent);
  std::string got;
  CHECK(comes_true([&] { return (got += read_some(line.master).value_or("")).size() >= every.size(); }));
  CHECK(got == every);
}

TEST_CASE("a way out that cannot be is a mistake of the user's, with what is allowed") {
  const int port = free_port(SOCK_STREAM);
  const auto taken = tcp_server_sender("127.0.0.1", port, kThisMachine);
  CHECK_THROWS_WITH(tcp_server_sender("127.0.0.1", port, kThisMachine),
                    Catch::Contains("allowed: a port that is free"));
  CHECK_THROWS_WITH(serial_sender("/dev/no_such_line", 9600), Catch::Contains("allowed: a line such as"));
  CHECK_THROWS_WITH(tcp_client_sender("nowhere", 1), Catch::Contains("is no host"));
}
