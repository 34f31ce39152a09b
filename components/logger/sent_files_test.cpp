#include "components/logger/sent_files.h"

#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <catch2/catch.hpp>
#include <fstream>
#include <iterator>
#include <thread>
#include <tuple>
#include <utility>

#include "components/formats/all/network.h"
#include "components/formats/kmall/parts.h"
#include "components/logger/testing/survey.h"

using namespace ensonify;
using namespace ensonify::logger::testing;
using Catch::Matchers::Contains;
using formats::Bytes;
using formats::ByteView;
namespace fs = std::filesystem;

namespace {

/// A socket on a port of the loopback interface that the system chose, and that port.
std::pair<int, int> bound_socket() {
  const int socket = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  REQUIRE(::bind(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0);
  socklen_t length = sizeof address;
  REQUIRE(::getsockname(socket, reinterpret_cast<sockaddr*>(&address), &length) == 0);
  return {socket, ntohs(address.sin_port)};
}

/// One that nobody reads.
int free_port() {
  const auto bound = bound_socket();
  ::close(bound.first);
  return bound.second;
}

/// Reads a port of the loopback interface until nothing has come for a second.
class Reader {
 public:
  Reader() {
    std::tie(socket_, port_) = bound_socket();
    const timeval patience{1, 0};
    ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    const int room = 4 << 20;
    ::setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &room, sizeof room);
    thread_ = std::thread([this] { read(); });
  }
  ~Reader() {
    if (thread_.joinable()) thread_.join();
    ::close(socket_);
  }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  int port() const { return port_; }
  const std::vector<Bytes>& all() {
    if (thread_.joinable()) thread_.join();
    return received_;
  }

 private:
  void read() {
    std::array<std::byte, 65'536> buffer;
    for (;;) {
      const ssize_t got = ::recv(socket_, buffer.data(), buffer.size(), 0);
      if (got < 0 && received_.empty() && ++empty_ < 30) continue;  // the survey has not begun
      if (got < 0) return;
      received_.emplace_back(buffer.begin(), buffer.begin() + got);
    }
  }

  int socket_ = -1, port_ = 0;
  int empty_ = 0;
  std::vector<Bytes> received_;
  std::thread thread_;
};

Bytes bytes_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  const std::vector<char> text{std::istreambuf_iterator<char>(in), {}};
  const ByteView view = std::as_bytes(std::span(text));
  return {view.begin(), view.end()};
}

void append(Bytes& file, const std::optional<Bytes>& datagram) {
  if (datagram) file.insert(file.end(), datagram->begin(), datagram->end());
}

Bytes all_file(const std::vector<Bytes>& received) {
  Bytes file;
  for (const Bytes& one : received) {
    const auto datagram = formats::all::from_network(one);
    REQUIRE(datagram);
    append(file, datagram);
  }
  return file;
}

Bytes kmall_file(const std::vector<Bytes>& received) {
  Bytes file;
  formats::kmall::PartJoiner joiner;
  for (const Bytes& one : received) {
    REQUIRE(one.size() <= formats::kmall::kMostPartBytes);
    append(file, joiner.take(one));
  }
  CHECK(joiner.counts().refused == 0);
  return file;
}

std::string problem(const char* send, const char* formats = "[all]") {
  try {
    config_of(bay(), fmt::format("formats: {}\nsend: {}", formats, send).c_str());
  } catch (const UserError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("each stream has the datagrams of its file, from the opening on to the end") {
  const Folder folder;
  Reader all, kmall, wcd, kmwcd;
  logger::testing::survey(bay(),
                          fmt::format("{{formats: [all, kmall, wcd, kmwcd], send: [{{to: '{}'}}, {{to: '{}', formats: "
                                      "[kmall]}}, {{to: '{}', formats: [wcd]}}, {{to: '{}', formats: [kmwcd]}}]}}",
                                      all.port(), kmall.port(), wcd.port(), kmwcd.port())
                              .c_str(),
                          folder.path);
  const auto logged = [&](const char* ending) {
    Bytes bytes = bytes_of(folder.path / (std::string("0000_20250601_120000_boat.") + ending));
    REQUIRE(bytes.size() > 10'000);
    return bytes;
  };
  CHECK((all_file(all.all()) == logged("all")));
  CHECK((all_file(wcd.all()) == logged("wcd")));
  CHECK((kmall_file(kmall.all()) == logged("kmall")));
  CHECK((kmall_file(kmwcd.all()) == logged("kmwcd")));
}

TEST_CASE("beside .all a water column is k alone, beside .kmall #CHE and #MWC") {
  const Folder folder;
  Reader reader, km;
  logger::testing::survey(bay(),
                          fmt::format("{{formats: [all, kmall, wcd, kmwcd], send: [{{to: '{}', formats: [all, wcd]}}, "
                                      "{{to: '{}', formats: [kmwcd, kmall]}}]}}",
                                      reader.port(), km.port())
                              .c_str(),
                          folder.path);
  std::vector<Bytes> soundings, km_soundings;
  std::string others, km_others;
  for (const Bytes& one : reader.all()) {
    if (one[1] == std::byte{'k'}) others += 'k';
    else soundings.push_back(one);
  }
  for (const Bytes& one : km.all()) {
    const std::string type(reinterpret_cast<const char*>(one.data()) + 4, 4);
    if (type == "#CHE" || type == "#MWC") km_others += type;
    else km_soundings.push_back(one);
  }
  CHECK((all_file(soundings) == bytes_of(folder.path / "0000_20250601_120000_boat.all")));
  CHECK((kmall_file(km_soundings) == bytes_of(folder.path / "0000_20250601_120000_boat.kmall")));
  CHECK(others.size() > 10);
  CHECK_THAT(km_others, Contains("#CHE#MWC"));
}

TEST_CASE("receivers that are not there leave the files as they are") {
  const Folder with, without;
  const int port = free_port();
  survey(bay(), fmt::format("{{folder: absent, send: [{{to: '{}', rate_mb_s: 0.01}}]}}", port).c_str(), with.path);
  survey(bay(), "{folder: none}", without.path);
  const char* name = "0000_20250601_120000_boat.all";
  CHECK((bytes_of(with.path / "absent" / name) == bytes_of(without.path / "none" / name)));
}

TEST_CASE("receivers that cannot be are refused with place and what is allowed") {
  CHECK_THAT(problem("[{to: ship:16101}]"), Contains("send[0].to: \"ship\" is no host; allowed: an IPv4 address"));
  CHECK_THAT(problem("[{to: '127.0.0.1:70000'}]"), Contains("send[0].to: \"70000\" is no port; allowed: 1 to 65535"));
  CHECK_THAT(problem("[{formats: [all]}]"), Contains("send[0].to"));
  CHECK_THAT(problem("[{to: '1'}, {to: '2', formats: [xtf]}]"),
             Contains("send[1].formats: \"xtf\" is no format; allowed: all, kmall, wcd, kmwcd"));
  CHECK_THAT(problem("[{to: '1', formats: [kmall]}]"),
             Contains("send[0].formats: kmall is sent as it is logged, and formats does not name it; it names: all"));
  CHECK_THAT(problem("[{to: '1'}, {to: 'localhost:1'}]"), Contains("send[1].to: localhost:1 is a receiver already"));
  CHECK_THAT(problem("[{to: '1', rate_mb_s: 0}]"), Contains("send[0].rate_mb_s: 0 is outside [0.01, 1000]"));
  CHECK_THAT(problem("[{to: '239.1.2.3:1', interface: eth0}]"),
             Contains("send[0].interface: \"eth0\" is no address of an interface"));
  CHECK_THAT(problem("[{to: '239.1.2.3:1', ttl: 300}]"), Contains("send[0].ttl: 300 is outside [0, 255]"));
  CHECK(problem("[{to: '239.1.2.3:1', ttl: 0, interface: 127.0.0.1, formats: [kmall, all]}]", "[all, kmall]").empty());
}
