#include "components/transport/send_stream.h"

#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <catch2/catch.hpp>
#include <cstring>
#include <optional>
#include <string>

#include "components/errors/exit_error.h"
#include "components/transport/socket_address.h"
#include "components/transport/udp_sender.h"

using namespace ensonify;
using Catch::Matchers::Contains;

namespace {

constexpr double kRate = 50e6;

/// A receiver on the loopback interface, of a group where one is given. It waits for at most two seconds.
class Receiver {
 public:
  explicit Receiver(const char* group = nullptr) : socket_(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
    const timeval patience{2, 0};
    ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    const Address own = host_address(group != nullptr ? group : "127.0.0.1");
    const SocketAddress address(own);
    REQUIRE(::bind(socket_, address.data(), address.size()) == 0);
    if (group != nullptr) {
      ip_mreq member{{}, {htonl(INADDR_LOOPBACK)}};
      std::memcpy(&member.imr_multiaddr, own.bytes.data(), sizeof member.imr_multiaddr);
      REQUIRE(::setsockopt(socket_, IPPROTO_IP, IP_ADD_MEMBERSHIP, &member, sizeof member) == 0);
    }
    SocketAddress given;
    REQUIRE(::getsockname(socket_, given.data(), given.size_given()) == 0);
    address_ = given.address();
  }
  ~Receiver() { ::close(socket_); }
  Receiver(const Receiver&) = delete;
  Receiver& operator=(const Receiver&) = delete;

  const Address& address() const { return address_; }
  std::optional<std::string> take() {
    std::array<char, 65'536> buffer;
    const ssize_t got = ::recv(socket_, buffer.data(), buffer.size(), 0);
    if (got < 0) return std::nullopt;
    return std::string(buffer.data(), static_cast<std::size_t>(got));
  }

 private:
  int socket_;
  Address address_;
};

const Address kLoopback = interface_address("localhost");

std::vector<std::byte> bytes_of(const std::string& text) {
  const auto view = std::as_bytes(std::span(text));
  return {view.begin(), view.end()};
}

/// A port of this machine that nobody reads: it was just free.
Address absent() { return Receiver().address(); }

}  // namespace

TEST_CASE("datagrams arrive whole and in their order, the longest among them") {
  Receiver receiver;
  SendStream stream(std::make_unique<UdpSender>(receiver.address(), kLoopback, 1), kRate);
  const std::vector<std::string> sent{"first", std::string(UdpSender::kMostBytes, 'x'), "", "last"};
  for (const std::string& one : sent) {
    stream.offer(bytes_of(one));
    CHECK(receiver.take() == one);
  }
  stream.finish();
  const SendStream::Counts counts = stream.counts();
  CHECK(counts.datagrams == 4);
  CHECK(counts.bytes == static_cast<std::int64_t>(UdpSender::kMostBytes) + 9);
  CHECK(counts.lost + counts.refused == 0);
  CHECK(counts.latest_s > 0.0);
}

TEST_CASE("a group on the loopback interface gets what is sent to it") {
  Receiver receiver("239.255.77.1");
  SendStream stream(std::make_unique<UdpSender>(receiver.address(), kLoopback, 1), kRate);
  stream.offer(bytes_of("to all"));
  CHECK(receiver.take() == "to all");
}

TEST_CASE("a receiver that is not there is counted and is no error") {
  SendStream stream(std::make_unique<UdpSender>(absent(), kLoopback, 1), kRate);
  for (int i = 0; i < 50; ++i) stream.offer(bytes_of("nobody"));
  stream.finish();
  const SendStream::Counts counts = stream.counts();
  CHECK(counts.datagrams == 50);
  CHECK(counts.refused >= 40);  // that of the last comes when nothing more is sent
  CHECK(counts.lost == 0);
}

TEST_CASE("a way that is not there loses datagrams and is no error") {
  // Sending to everybody at once takes a permission that these sockets do not ask for.
  UdpSender sender(receiver_address("127.255.255.255", 9), kLoopback, 1);
  CHECK(sender.send(bytes_of("nowhere")) == Sender::Outcome::unreachable);
  SendStream stream(std::make_unique<UdpSender>(receiver_address("127.255.255.255", 9), kLoopback, 1), kRate);
  stream.offer(bytes_of("nowhere"));
  stream.finish();
  CHECK(stream.counts().lost == 1);
}

TEST_CASE("what no datagram holds is lost, and the next is sent") {
  Receiver receiver;
  SendStream stream(std::make_unique<UdpSender>(receiver.address(), kLoopback, 1), kRate);
  stream.offer(std::vector<std::byte>(UdpSender::kMostBytes + 1));
  stream.offer(bytes_of("next"));
  CHECK(receiver.take() == "next");
  stream.finish();
  CHECK(stream.counts().lost == 1);
}

TEST_CASE("offering never waits: what does not fit at the rate is lost, and the end comes in time") {
  Receiver receiver;
  SendStream stream(std::make_unique<UdpSender>(receiver.address(), kLoopback, 1), 10e3);  // two seconds are 20 kB
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < 1'000; ++i) stream.offer(std::vector<std::byte>(1'000));
  CHECK(std::chrono::steady_clock::now() - begin < std::chrono::seconds(1));
  const std::int64_t lost = stream.counts().lost;
  CHECK(lost >= 970);
  CHECK(lost <= 981);
  stream.finish();
  CHECK(std::chrono::steady_clock::now() - begin < std::chrono::seconds(4));
  const SendStream::Counts counts = stream.counts();
  CHECK(counts.datagrams + counts.lost == 1'000);
  CHECK(counts.late > 10);
  CHECK(counts.latest_s > 1.0);
}

TEST_CASE("an interface that this machine has not is refused with what is allowed") {
  CHECK_THROWS_WITH(UdpSender(udp_address("239.255.77.1:16101"), interface_address("203.0.113.7"), 1),
                    Contains("cannot send to 239.255.77.1:16101 by the interface 203.0.113.7") &&
                        Contains("allowed: the address of an interface of this machine"));
}
